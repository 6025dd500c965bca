#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace lorentz {

/// The range of a number, ends included. Whole numbers end at 2^63 - 1 where `high` is infinite.
struct Range {
  double low = 0;
  double high = std::numeric_limits<double>::infinity();
};

/// Magnitudes of every option with units. All that programs compute from positive ones is representable with
/// full precision, up to fourth powers of displacements.
inline constexpr Range positive{1e-30, 1e30}, non_negative{0, 1e30};

/// A value in a file. Whole numbers are signed, so that differences of them are right in any language.
using AttributeValue = std::variant<bool, std::int64_t, double, std::string>;

/// The value of an option as it is recorded in the output file.
struct Parameter {
  std::string name;  // without the leading dashes
  AttributeValue value;
  std::string units{}, role{}, rule{};  // as those of Option
};

std::string as_text(const AttributeValue& value);

/// What an option changes. All but those of `execution` determine the result, and are recorded in it.
enum class Role {
  physics,    // the model
  effort,     // only the errors of the numbers
  output,     // which numbers of the model are written
  execution,  // nothing in the result: threads, progress, files
};

/// One option: its only description, for the command line, --help, messages, the record of parameters in the
/// output file and --describe.
struct Option {
  Role role;
  std::string name;  // with the leading dashes
  /// The variable, whose value is the default until the command line sets it. None of an optional one is
  /// stated by a word.
  std::variant<double*, std::uint32_t*, std::uint64_t*, std::optional<double>*, std::optional<std::uint32_t>*,
               std::vector<double>*, bool*, std::string*>
      variable;
  Range range;        // of numbers
  std::string units;  // a dimension, such as "temperature" or "1/time", or "1"; empty for words
  std::string help;
  std::vector<std::string> words{};  // choices of a text, or the word for none
  bool required = false;             // by every run
  std::string rule{};                // collision rule that alone has and requires the option; empty: none
  AttributeValue default_value{};    // set by Options
  bool given = false;                // on the command line

  template <class... Types>
  bool is_one_of() const {
    return (std::holds_alternative<Types*>(variable) || ...);
  }
  bool is_flag() const { return is_one_of<bool>(); }
  bool is_text() const { return is_one_of<std::string>(); }
  bool is_list() const { return is_one_of<std::vector<double>>(); }
  bool has_default() const { return !required && rule.empty(); }
  bool is_whole() const { return is_one_of<std::uint32_t, std::uint64_t, std::optional<std::uint32_t>>(); }
  std::string end(double limit) const;  // an end of the range as text
  AttributeValue value() const;
  std::string allowed() const;  // values, for messages
  std::string role_name() const;

  /// Sets the variable; returns false, with the variable unspecified, if the text is not an allowed value.
  bool read(const std::string& text) const;
};

/// The options of one executable.
class Options {
 public:
  Options(std::string program, std::string description);

  /// Declare an option. Names have their leading dashes.
  void real(Role role, const std::string& name, double& value, Range range, const std::string& units,
            const std::string& help) {
    add({role, name, &value, range, units, help});
  }
  template <class Whole>
  void integer(Role role, const std::string& name, Whole& value, Range range, const std::string& help) {
    add({role, name, &value, range, "1", help});
  }
  template <class Whole>
  void required_integer(Role role, const std::string& name, Whole& value, Range range,
                        const std::string& help) {
    add({role, name, &value, range, "1", help, {}, true});
  }
  /// A number, or a word, for which the value is none: --gamma N.
  void real_or_word(Role role, const std::string& name, std::optional<double>& value, Range range,
                    const std::string& word, const std::string& units, const std::string& help) {
    add({role, name, &value, range, units, help, {word}});
  }
  void integer_or_word(Role role, const std::string& name, std::optional<std::uint32_t>& value, Range range,
                       const std::string& word, const std::string& help) {
    add({role, name, &value, range, "1", help, {word}});
  }
  /// A number that a choice of --rule requires, and no other allows: recorded only if it is given.
  void of_rule(const std::string& rule, const std::string& name, std::optional<double>& value, Range range,
               const std::string& units, const std::string& help) {
    add({Role::physics, name, &value, range, units, help, {}, false, rule});
  }
  /// Increasing numbers, separated by commas.
  void ascending_list(Role role, const std::string& name, std::vector<double>& values, Range range,
                      const std::string& units, const std::string& help) {
    add({role, name, &values, range, units, help});
  }
  void flag(Role role, const std::string& name, bool& value, const std::string& help) {
    add({role, name, &value, {}, "", help});
  }
  void choice(Role role, const std::string& name, std::string& value, const std::vector<std::string>& choices,
              const std::string& help) {
    add({role, name, &value, {}, "", help, choices});
  }
  void text(Role role, const std::string& name, std::string& value, const std::string& help) {
    add({role, name, &value, {}, "", help});
  }

  /// Whether the command line has the option.
  bool given(const std::string& name) const { return named(name).given; }
  const std::string& program() const { return program_; }
  const std::vector<Option>& all() const { return options_; }

  /// Reads the command line. Returns the text of --help, which ends with the footer, or of --version if one
  /// is given, after which the program ends; none otherwise. Throws UsageError.
  std::optional<std::string> parse(int argc, const char* const* argv, const std::string& version,
                                   const std::function<std::string()>& footer);

  /// Leaves an option out of parameters(): others determine the result.
  void omit(const std::string& name);

  /// Words of the command line for options that determine the result, as they were given, separated by
  /// spaces: a part of the result's identity (workflow/lib/identity.py).
  const std::string& option_words() const { return option_words_; }

  /// Values of all options that determine the result, sorted by name, as relaxation_time of
  /// --relaxation-time; of a rule, those that are given.
  std::vector<Parameter> parameters() const;

 private:
  void add(Option option);
  const Option& named(const std::string& name) const;
  void read(std::span<const char* const> words);
  std::string help() const;
  [[noreturn]] void refuse(const std::string& why) const;
  [[noreturn]] void refuse_unknown(const std::string& word) const;

  std::string program_, description_, option_words_;
  std::vector<Option> options_;
};

}  // namespace lorentz
