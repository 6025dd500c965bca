#include "program/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iostream>

#include "program/errors.hpp"

namespace lorentz {
namespace {

/// Whole numbers are recorded in one width.
template <class Number>
using Recorded = std::conditional_t<std::is_integral_v<Number>, std::uint64_t, Number>;

template <class Number>
std::string interval(const Range<Number>& range) {
  const bool bounded_above = range.high != std::numeric_limits<Number>::max();
  const bool bounded_below = range.low != std::numeric_limits<Number>::lowest() || range.low == 0;
  const char* relation = range.open_below ? "greater than" : "at least";
  if (bounded_below && bounded_above)
    return fmt::format("in {}{}, {}]", range.open_below ? '(' : '[', range.low, range.high);
  if (bounded_below) return fmt::format("{} {}", relation, range.low);
  if (bounded_above) return fmt::format("at most {}", range.high);
  return "finite";
}

/// Reads a decimal number, rounded to the nearest that there is; false if the text is not one.
template <class Number>
bool read_number(const std::string& text, Number& value) {
  const char* end = text.data() + text.size();
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const auto [stop, error] = std::from_chars(begin, end, value);
  return error == std::errc{} && stop == end && std::isfinite(static_cast<double>(value));
}

/// The number in a text to which there is no objection.
template <class Number>
Number number_in(const std::string& text) {
  Number value{};
  read_number(text, value);
  return value;
}

/// Why the text is not an admissible number; empty if it is.
template <class Number>
std::string objection(const std::string& text, const Range<Number>& range) {
  constexpr const char* kind = std::is_integral_v<Number> ? "whole number" : "number";
  Number value{};
  const bool inside = read_number(text, value) &&
                      (range.open_below ? value > range.low : value >= range.low) && value <= range.high;
  if (inside) return {};
  return fmt::format("'{}' cannot be used: it must be a {} {}", text, kind, interval(range));
}

}  // namespace

Options::Options(std::string program, const std::string& description)
    : app_(description, program), program_(std::move(program)) {
  app_.set_config("--config", "", "Read options from a TOML file (keys without the dashes)");
  app_.allow_config_extras(false);
  app_.set_version_flag("--version", std::string{}, "Print version and build id, then exit");
  app_.get_formatter()->column_width(36);
}

void Options::record(const std::string& name, Role role, std::function<AttributeValue()> value) {
  if (role == Role::result) recorded_.emplace_back(name.substr(2), std::move(value));
}

template <class Number>
void Options::number(const std::string& name, Number& value, Range<Number> range, const std::string& help,
                     Role role) {
  record(name, role, [&value] { return AttributeValue(Recorded<Number>{value}); });
  const auto read = [&value](const std::string& text) { value = number_in<Number>(text); };
  app_.add_option_function<std::string>(name, read,
                                        fmt::format("{} ({}; default {})", help, interval(range), value))
      ->check([range](const std::string& text) { return objection(text, range); })
      ->type_name("")
      ->multi_option_policy(CLI::MultiOptionPolicy::Throw);
}

void Options::real(const std::string& name, double& value, Range<double> range, const std::string& help,
                   Role role) {
  number(name, value, range, help, role);
}

void Options::integer(const std::string& name, std::uint32_t& value, Range<std::uint32_t> range,
                      const std::string& help, Role role) {
  number(name, value, range, help, role);
}

void Options::integer(const std::string& name, std::uint64_t& value, Range<std::uint64_t> range,
                      const std::string& help, Role role) {
  number(name, value, range, help, role);
}

void Options::real_or_word(const std::string& name, double& value, Range<double> range,
                           const std::string& word, double meaning, const std::string& help, Role role) {
  const std::string preset = value == meaning ? word : fmt::format("{}", value);
  record(name, role,
         [&value, word, meaning] { return value == meaning ? AttributeValue(word) : AttributeValue(value); });
  const auto read = [&value, word, meaning](const std::string& text) {
    value = text == word ? meaning : number_in<double>(text);
  };
  app_.add_option_function<std::string>(
          name, read, fmt::format("{} ({}, or {}; default {})", help, interval(range), word, preset))
      ->check([range, word](const std::string& text) {
        const std::string why = text == word ? std::string{} : objection(text, range);
        return why.empty() ? why : fmt::format("{}, or {}", why, word);
      })
      ->type_name("")
      ->multi_option_policy(CLI::MultiOptionPolicy::Throw);
}

void Options::scaled(const std::string& name, Scaled& value, Range<double> range, const std::string& help,
                     Role role) {
  const auto as_given = [](const Scaled& scaled) {
    return fmt::format("{}{}", scaled.factor, scaled.per_cell ? "N" : "");
  };
  record(name, role, [&value, as_given] {
    return value.per_cell ? AttributeValue(as_given(value)) : AttributeValue(value.factor);
  });
  const auto factor = [](const std::string& text) {
    return text.ends_with('N') ? text.substr(0, text.size() - 1) : text;
  };
  const auto read = [&value, factor](const std::string& text) {
    value = {number_in<double>(factor(text)), text.ends_with('N')};
  };
  app_.add_option_function<std::string>(
          name, read,
          fmt::format("{} ({}, or such a number of N; default {})", help, interval(range), as_given(value)))
      ->check([range, factor](const std::string& text) {
        const std::string why = objection(factor(text), range);
        return why.empty() ? why : fmt::format("{}, or such a number followed by N", why);
      })
      ->type_name("")
      ->multi_option_policy(CLI::MultiOptionPolicy::Throw);
}

void Options::ascending_list(const std::string& name, std::vector<double>& values, Range<double> range,
                             const std::string& help, Role role) {
  record(name, role, [&values] { return AttributeValue(fmt::format("{}", fmt::join(values, ","))); });
  const auto read = [&values](const std::string& text) {
    values.clear();
    for (const std::string& item : CLI::detail::split(text, ',')) values.push_back(number_in<double>(item));
  };
  app_.add_option_function<std::string>(
          name, read,
          fmt::format("{} (each {}, ascending; default {})", help, interval(range), fmt::join(values, ",")))
      ->check([range](const std::string& text) {
        double last = -std::numeric_limits<double>::infinity();
        for (const std::string& item : CLI::detail::split(text, ',')) {
          if (std::string why = objection(item, range); !why.empty()) return why;
          if (!(number_in<double>(item) > last))
            return fmt::format("'{}' cannot be used: the numbers must ascend", text);
          last = number_in<double>(item);
        }
        return std::string{};
      })
      ->type_name("")
      ->multi_option_policy(CLI::MultiOptionPolicy::Throw);
}

void Options::flag(const std::string& name, bool& value, const std::string& help, Role role) {
  app_.add_flag(name, value, help);
  record(name, role, [&value] { return AttributeValue(value); });
}

void Options::choice(const std::string& name, std::string& value, const std::vector<std::string>& choices,
                     const std::string& help, Role role) {
  app_.add_option(name, value,
                  fmt::format("{} (one of {}; default {})", help, fmt::join(choices, ", "), value))
      ->check([choices](const std::string& text) {
        if (std::find(choices.begin(), choices.end(), text) != choices.end()) return std::string{};
        return fmt::format("'{}' cannot be used: it must be one of {}", text, fmt::join(choices, ", "));
      })
      ->type_name("");
  record(name, role, [&value] { return AttributeValue(value); });
}

void Options::text(const std::string& name, std::string& value, const std::string& help, Role role) {
  app_.add_option(name, value, help)->type_name("");
  record(name, role, [&value] { return AttributeValue(value); });
}

bool Options::parse(int argc, const char* const* argv, const std::string& version_text) {
  try {
    app_.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    std::cout << app_.help();
    return false;
  } catch (const CLI::CallForVersion&) {
    std::cout << version_text << '\n';
    return false;
  } catch (const CLI::ParseError& error) {
    throw UsageError(fmt::format("{}. Correct it; '{} --help' lists every option.", error.what(), program_));
  }
  return true;
}

std::vector<Parameter> Options::parameters() const {
  std::vector<Parameter> result;
  for (const auto& [name, value] : recorded_) result.push_back({name, value()});
  std::sort(result.begin(), result.end(),
            [](const Parameter& a, const Parameter& b) { return a.name < b.name; });
  return result;
}

std::string as_text(const std::vector<Parameter>& parameters) {
  std::string text;
  for (const Parameter& parameter : parameters)
    std::visit([&](const auto& value) { text += fmt::format("{} = {}\n", parameter.name, value); },
               parameter.value);
  return text;
}

}  // namespace lorentz
