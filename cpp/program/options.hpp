#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace CLI {
class App;
}

namespace lorentz {

/// The range of a number: [low, high], or greater than low.
template <class Number>
struct Range {
  Number low = 0;
  Number high = std::numeric_limits<Number>::max();
  bool open_below = false;

  bool bounded_above() const { return high != std::numeric_limits<Number>::max(); }
  bool contains(Number value) const { return (open_below ? value > low : value >= low) && value <= high; }
};

inline constexpr Range<double> positive{0, std::numeric_limits<double>::max(), true};
inline constexpr Range<double> non_negative{0};

/// A polynomial of the second degree in a size of the system, most often a number.
struct Scaled {
  std::array<double, 3> coefficients;  // of size^0, size^1, size^2

  double at(double size) const { return coefficients[0] + size * (coefficients[1] + size * coefficients[2]); }
};

using AttributeValue = std::variant<bool, std::int64_t, std::uint64_t, double, std::string>;

/// The value of an option as it is recorded in the output file.
struct Parameter {
  std::string name;  // without the leading dashes
  AttributeValue value;
};

std::string as_text(const AttributeValue& value);

struct Option;

/// The options of one executable. One declaration of each serves the command line, --help, the check, the
/// record of parameters in the output file and describe(). parse() writes to the declared values.
class Options {
 public:
  enum class Role {
    result,   // determines the result: recorded in the output file
    runtime,  // how the run is conducted: threads, progress, files
  };

  Options(std::string program, const std::string& description);
  ~Options();

  /// The current value is the default. Names have their leading dashes. Units are a dimension, such as
  /// "temperature" or "1/time", or "1".
  void real(const std::string& name, double& value, Range<double> range, const std::string& units,
            const std::string& help, Role role = Role::result);
  void integer(const std::string& name, std::uint32_t& value, Range<std::uint32_t> range,
               const std::string& help, Role role = Role::result);
  void integer(const std::string& name, std::uint64_t& value, Range<std::uint64_t> range,
               const std::string& help, Role role = Role::result);
  /// A number, or a word, for which the value is none: --gamma N.
  void real_or_word(const std::string& name, std::optional<double>& value, Range<double> range,
                    const std::string& word, const std::string& units, const std::string& help);
  void integer_or_word(const std::string& name, std::optional<std::uint32_t>& value,
                       Range<std::uint32_t> range, const std::string& word, const std::string& help);
  /// A number, or a sum of multiples of 1, N and N^2, as 50+0.0004N^2.
  void scaled(const std::string& name, Scaled& value, Range<double> range, const std::string& units,
              const std::string& help);
  /// Increasing numbers, separated by commas.
  void ascending_list(const std::string& name, std::vector<double>& values, Range<double> range,
                      const std::string& units, const std::string& help);
  void flag(const std::string& name, bool& value, const std::string& help, Role role = Role::result);
  void choice(const std::string& name, std::string& value, const std::vector<std::string>& choices,
              const std::string& help, Role role = Role::result);
  void text(const std::string& name, std::string& value, const std::string& help, Role role = Role::result);

  /// Whether the command line has the option.
  bool given(const std::string& name) const;
  const std::string& program() const { return program_; }

  /// Reads the command line. Returns the text of --help or --version if one is given, after which the program
  /// ends; none otherwise. Throws UsageError.
  std::optional<std::string> parse(int argc, const char* const* argv, const std::string& version);

  /// Words of the command line for options that determine the result, as they were given, separated by
  /// spaces: a part of the result's identity (workflow/identity.py).
  const std::string& words() const { return words_; }

  /// Values of all options that determine the result, sorted by name.
  std::vector<Parameter> parameters() const;

  /// JSON array of the options in the order of declaration: name, type, limits, default, units, description.
  std::string describe() const;

 private:
  void add(const std::string& name, const std::string& units, const std::string& help, Role role,
           Option option);

  std::string program_, words_;
  std::unique_ptr<CLI::App> app_;
  std::vector<Option> options_;
};

}  // namespace lorentz
