#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "program/number_text.hpp"

namespace CLI {
class App;
}

namespace lorentz {

struct Option;

using AttributeValue = std::variant<bool, std::int64_t, std::uint64_t, double, std::string>;

/// The value of an option as it goes into the output file.
struct Parameter {
  std::string name;  // without the leading dashes
  AttributeValue value;
};

/// The options of one executable. One declaration of each serves the command line, the configuration file,
/// --help, the check, the record of parameters in the output file and describe().
///
/// parse() writes to the values that were declared: they must not be const, nor move. So a class with options
/// declares them in a function that is not const, and is written to by nothing else.
class Options {
 public:
  enum class Role {
    result,   // determines the result: recorded in the output file
    runtime,  // how the run is conducted: threads, progress, files
  };

  Options(std::string program, const std::string& description);
  ~Options();

  /// The value given is the default. Names carry their leading dashes. Units are a dimension, such as
  /// "temperature" or "1/time", or "1".
  void real(const std::string& name, double& value, Range<double> range, const std::string& units,
            const std::string& help, Role role = Role::result);
  void integer(const std::string& name, std::uint32_t& value, Range<std::uint32_t> range,
               const std::string& help, Role role = Role::result);
  void integer(const std::string& name, std::uint64_t& value, Range<std::uint64_t> range,
               const std::string& help, Role role = Role::result);
  /// A number, or a word, for which the value is none: --gamma N.
  void real_or_word(const std::string& name, std::optional<double>& value, Range<double> range,
                    const std::string& word, const std::string& units, const std::string& help,
                    Role role = Role::result);
  void integer_or_word(const std::string& name, std::optional<std::uint32_t>& value,
                       Range<std::uint32_t> range, const std::string& word, const std::string& help,
                       Role role = Role::result);
  /// A number, or a sum of a number and multiples of a size and its square: 0.05N or 50+0.0004N^2 with the
  /// symbol 'N'.
  void scaled(const std::string& name, Scaled& value, Range<double> range, char symbol,
              const std::string& units, const std::string& help, Role role = Role::result);
  /// Increasing numbers, separated by commas.
  void ascending_list(const std::string& name, std::vector<double>& values, Range<double> range,
                      const std::string& units, const std::string& help, Role role = Role::result);
  void flag(const std::string& name, bool& value, const std::string& help, Role role = Role::result);
  void choice(const std::string& name, std::string& value, const std::vector<std::string>& choices,
              const std::string& help, Role role = Role::result);
  void text(const std::string& name, std::string& value, const std::string& help, Role role = Role::result);

  /// Whether the command line or the configuration file has the option.
  bool given(const std::string& name) const;
  const std::string& program() const { return program_; }

  /// Reads the command line and the configuration file that it names; the command line has the last word.
  /// Returns true if the program should go on; false after --help or --version, which print to
  /// standard output. Throws UsageError.
  bool parse(int argc, const char* const* argv, const std::string& version_text);

  /// Throws UsageError if a file that is to be written is the configuration file, under whatever name.
  void require_not_configuration(const std::string& path) const;

  /// Values of all options that determine the result, sorted by name.
  std::vector<Parameter> parameters() const;

  /// The options in the order of declaration: name, type, limits, default, units, description.
  nlohmann::json describe() const;

 private:
  void add(const std::string& name, const std::string& help, Role role, Option option);
  void read(Option& option, const std::string& text, const std::string& place);
  void read_file(const std::string& path);
  [[noreturn]] void refuse(const std::string& why) const;
  [[noreturn]] void refuse_unknown(const std::string& word) const;

  /// Value on the command line; none without one. Throws UsageError if there are several.
  const std::string* argument(const std::string& name) const;

  /// Name of the option whose name, without the dashes, is nearest.
  std::string nearest(const std::string& name) const;

  std::string program_;
  std::unique_ptr<CLI::App> app_;
  std::vector<Option> options_;
};

/// One "name = value" line per parameter, numbers with all their digits.
std::string as_text(const std::vector<Parameter>& parameters);

}  // namespace lorentz
