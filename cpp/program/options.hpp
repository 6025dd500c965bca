#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <variant>
#include <vector>

namespace lorentz {

using AttributeValue = std::variant<bool, std::int64_t, std::uint64_t, double, std::string>;

/// The value of an option as it goes into the output file.
struct Parameter {
  std::string name;  // without the leading dashes
  AttributeValue value;
};

/// The admissible values of a number: [low, high], or (low, high] when the lower end is excluded.
template <class Number>
struct Range {
  Number low = std::numeric_limits<Number>::lowest();
  Number high = std::numeric_limits<Number>::max();
  bool open_below = false;
};

inline constexpr Range<double> positive{0, std::numeric_limits<double>::max(), true};
inline constexpr Range<double> non_negative{0};

/// A number, or a multiple of the number of cells.
struct Scaled {
  double factor;
  bool per_cell = false;

  double at(double cells) const { return per_cell ? factor * cells : factor; }
};

/// The options of one executable. Each is declared once, with its admissible range and units; that
/// one declaration serves the command line, the configuration file, --help, the check and the
/// record of parameters in the output file.
///
/// parse() writes to the values that were declared: they must not be const, nor move. So a class with options
/// declares them in a function that is not const, and is written to by nothing else.
class Options {
 public:
  enum class Role {
    result,   // determines the result: recorded in the output file
    conduct,  // how the run is conducted: threads, progress, files
  };

  Options(std::string program, const std::string& description);

  /// The value given is the default. Names carry their leading dashes.
  void real(const std::string& name, double& value, Range<double> range, const std::string& help,
            Role role = Role::result);
  void integer(const std::string& name, std::uint32_t& value, Range<std::uint32_t> range,
               const std::string& help, Role role = Role::result);
  void integer(const std::string& name, std::uint64_t& value, Range<std::uint64_t> range,
               const std::string& help, Role role = Role::result);
  /// A number, or a word that stands for a value: --gamma N. Recorded as given.
  void real_or_word(const std::string& name, double& value, Range<double> range, const std::string& word,
                    double meaning, const std::string& help, Role role = Role::result);
  /// A number, or one that ends with N for a multiple of the number of cells: 0.05N. Recorded as given.
  void scaled(const std::string& name, Scaled& value, Range<double> range, const std::string& help,
              Role role = Role::result);
  /// Increasing numbers, separated by commas.
  void ascending_list(const std::string& name, std::vector<double>& values, Range<double> range,
                      const std::string& help, Role role = Role::result);
  void flag(const std::string& name, bool& value, const std::string& help, Role role = Role::result);
  void choice(const std::string& name, std::string& value, const std::vector<std::string>& choices,
              const std::string& help, Role role = Role::result);
  void text(const std::string& name, std::string& value, const std::string& help, Role role = Role::result);

  bool given(const std::string& name) const { return app_.count(name) > 0; }
  const std::string& program() const { return program_; }

  /// Returns true if the program should go on; false after --help or --version, which print to
  /// standard output. Throws UsageError.
  bool parse(int argc, const char* const* argv, const std::string& version_text);

  /// Values of all options that determine the result, sorted by name.
  std::vector<Parameter> parameters() const;

 private:
  void record(const std::string& name, Role role, std::function<AttributeValue()> value);
  template <class Number>
  void number(const std::string& name, Number& value, Range<Number> range, const std::string& help,
              Role role);

  CLI::App app_;
  std::string program_;
  std::vector<std::pair<std::string, std::function<AttributeValue()>>> recorded_;
};

/// One "name = value" line per parameter, numbers with all their digits.
std::string as_text(const std::vector<Parameter>& parameters);

}  // namespace lorentz
