#include "program/options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

#include "program/errors.hpp"
#include "program/missing_in_libcxx.hpp"

namespace lorentz {

/// One option. Options::add() fills in name, help and role.
struct Option {
  std::string type;
  std::function<bool(const std::string&)> read;  // sets the value; false if the text is not admissible
  std::function<AttributeValue()> value;
  std::string admissible = {};  // "a number at least 0"; empty for any text
  std::string limits = {};      // further members of describe(): "minimum", "word", "units", ...
  std::string name = {}, help = {};
  Options::Role role = Options::Role::result;
};

namespace {

std::string json_of(const AttributeValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return '"' + *text + '"';
  const std::string number = as_text(value);
  const bool whole = std::holds_alternative<double>(value) && number.find_first_of(".e") == std::string::npos;
  return whole ? number + ".0" : number;
}

/// Whole numbers in one width.
template <class Number>
using Recorded = std::conditional_t<std::is_integral_v<Number>, std::uint64_t, double>;

/// The members of describe() that state a range.
template <class Number>
std::string limits(const Range<Number>& range) {
  const auto member = [](const char* name, Number value) {
    return fmt::format(R"(, "{}": {})", name, json_of(Recorded<Number>{value}));
  };
  return member(range.open_below ? "exclusive_minimum" : "minimum", range.low) +
         (range.bounded_above() ? member("maximum", range.high) : "");
}

template <class Number>
std::string interval(const Range<Number>& range) {
  if (range.bounded_above()) return fmt::format("in [{}, {}]", range.low, range.high);
  return fmt::format("{} {}", range.open_below ? "greater than" : "at least", range.low);
}

template <class Number>
std::string number_in(const Range<Number>& range) {
  return (std::is_integral_v<Number> ? "a whole number " : "a number ") + interval(range);
}

/// Sets the value to a decimal number, rounded to nearest; false if the text is not one in the range.
template <class Number>
bool read_number(const std::string& text, const Range<Number>& range, Number& value) {
  const char* begin = text.data() + (text.starts_with('+') && !text.starts_with("+-") ? 1 : 0);
  const char* end = text.data() + text.size();
  const auto [stop, error] = from_chars(begin, end, value);
  return error == std::errc{} && stop == end && range.contains(value);
}

constexpr std::array<const char*, 3> powers{"", "N", "N^2"};

/// Sets the value to a sum of terms: a coefficient in the range, and a power of N.
bool read_polynomial(const std::string& text, const Range<double>& range, Scaled& value) {
  value = {};
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  for (;; ++at) {
    double coefficient = 0;
    const auto [stop, error] = from_chars(at, end, coefficient);
    at = std::find(stop, end, '+');
    const auto* const power = std::ranges::find(powers, std::string(stop, at));
    if (error != std::errc{} || !range.contains(coefficient) || power == powers.end()) return false;
    value.coefficients[static_cast<std::size_t>(power - powers.begin())] += coefficient;
    if (at == end) return true;
  }
}

/// A number where it is constant, else the terms that are not 0.
AttributeValue polynomial(const Scaled& value) {
  if (value.coefficients[1] == 0 && value.coefficients[2] == 0) return value.coefficients[0];
  std::vector<std::string> terms;
  for (std::size_t power = 0; power < powers.size(); ++power)
    if (value.coefficients[power] != 0)
      terms.push_back(fmt::format("{}{}", value.coefficients[power], powers[power]));
  return fmt::format("{}", fmt::join(terms, "+"));
}

/// Sets the values to numbers separated by commas; false if they are not ascending and in the range.
bool read_list(const std::string& text, const Range<double>& range, std::vector<double>& values) {
  values.clear();
  for (std::size_t begin = 0, end = 0; end != text.size(); begin = end + 1) {
    end = std::min(text.find(',', begin), text.size());
    double value = 0;
    if (!read_number(text.substr(begin, end - begin), range, value)) return false;
    values.push_back(value);
  }
  return !values.empty() && std::ranges::adjacent_find(values, std::greater_equal()) == values.end();
}

template <class Number>
Option number(Number& value, Range<Number> range) {
  return {.type = std::is_integral_v<Number> ? "integer" : "number",
          .read = [&value, range](const std::string& text) { return read_number(text, range, value); },
          .value = [&value] { return AttributeValue(Recorded<Number>{value}); },
          .admissible = number_in(range),
          .limits = limits(range)};
}

/// The number is recorded as floating point, also where it is whole.
template <class Number>
Option number_or_word(std::optional<Number>& value, Range<Number> range, const std::string& word) {
  const auto read = [&value, range, word](const std::string& text) {
    if (text != word) return read_number(text, range, value.emplace());
    value.reset();
    return true;
  };
  const auto recorded = [&value, word] {
    return value ? AttributeValue(static_cast<double>(*value)) : AttributeValue(word);
  };
  return {.type = std::is_integral_v<Number> ? "integer or word" : "number or word",
          .read = read,
          .value = recorded,
          .admissible = number_in(range) + ", or " + word,
          .limits = limits(range) + fmt::format(R"(, "word": "{}")", word)};
}

/// Number of letters that differ: Levenshtein distance.
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j)
      diagonal = std::exchange(row[j + 1],
                               std::min({row[j] + 1, row[j + 1] + 1, diagonal + (a[i] == b[j] ? 0 : 1)}));
  }
  return row.back();
}

}  // namespace

std::string as_text(const AttributeValue& value) {
  return std::visit([](const auto& each) { return fmt::format("{}", each); }, value);
}

Options::Options(std::string program, const std::string& description)
    : program_(std::move(program)), app_(std::make_unique<CLI::App>(description, program_)) {
  app_->set_version_flag("--version", std::string{}, "Print version and hash of the sources, then exit");
  app_->get_formatter()->column_width(36);
  app_->allow_extras();  // parse() refuses them, with the name that is nearest
}

Options::~Options() = default;

void Options::add(const std::string& name, const std::string& units, const std::string& help, Role role,
                  Option option) {
  option.name = name;
  option.help = help;
  option.role = role;
  if (!units.empty()) option.limits += fmt::format(R"(, "units": "{}")", units);
  option.limits += fmt::format(R"(, "default": {})", json_of(option.value()));
  std::string text = help;
  if (!units.empty() && units != "1") text += fmt::format(" [{}]", units);
  if (!option.admissible.empty())
    text += fmt::format(" ({}; default {})", option.admissible, as_text(option.value()));
  if (option.type == "flag")
    app_->add_flag(name, help);
  else
    app_->add_option(name, CLI::callback_t{}, text)->type_name("")->take_all();
  options_.push_back(std::move(option));
}

void Options::real(const std::string& name, double& value, Range<double> range, const std::string& units,
                   const std::string& help, Role role) {
  add(name, units, help, role, number(value, range));
}

void Options::integer(const std::string& name, std::uint32_t& value, Range<std::uint32_t> range,
                      const std::string& help, Role role) {
  add(name, "1", help, role, number(value, range));
}

void Options::integer(const std::string& name, std::uint64_t& value, Range<std::uint64_t> range,
                      const std::string& help, Role role) {
  add(name, "1", help, role, number(value, range));
}

void Options::real_or_word(const std::string& name, std::optional<double>& value, Range<double> range,
                           const std::string& word, const std::string& units, const std::string& help) {
  add(name, units, help, Role::result, number_or_word(value, range, word));
}

void Options::integer_or_word(const std::string& name, std::optional<std::uint32_t>& value,
                              Range<std::uint32_t> range, const std::string& word, const std::string& help) {
  add(name, "1", help, Role::result, number_or_word(value, range, word));
}

void Options::scaled(const std::string& name, Scaled& value, Range<double> range, const std::string& units,
                     const std::string& help) {
  add(name, units, help, Role::result,
      {.type = "number or polynomial in N",
       .read = [&value, range](const std::string& text) { return read_polynomial(text, range, value); },
       .value = [&value] { return polynomial(value); },
       .admissible = number_in(range) + ", or a sum of such, each alone or followed by N or N^2",
       .limits = limits(range)});
}

void Options::ascending_list(const std::string& name, std::vector<double>& values, Range<double> range,
                             const std::string& units, const std::string& help) {
  add(name, units, help, Role::result,
      {.type = "numbers",
       .read = [&values, range](const std::string& text) { return read_list(text, range, values); },
       .value = [&values] { return AttributeValue(fmt::format("{}", fmt::join(values, ","))); },
       .admissible = fmt::format("numbers {}, ascending, separated by commas", interval(range)),
       .limits = limits(range)});
}

void Options::flag(const std::string& name, bool& value, const std::string& help, Role role) {
  const auto read = [&value](const std::string& text) {
    value = text == "true";
    return value || text == "false";
  };
  add(name, "", help, role,
      {.type = "flag",
       .read = read,
       .value = [&value] { return AttributeValue(value); },
       .admissible = "true or false"});
}

void Options::choice(const std::string& name, std::string& value, const std::vector<std::string>& choices,
                     const std::string& help, Role role) {
  const auto read = [&value, choices](const std::string& text) {
    value = text;
    return std::ranges::find(choices, text) != choices.end();
  };
  add(name, "", help, role,
      {.type = "choice",
       .read = read,
       .value = [&value] { return AttributeValue(value); },
       .admissible = fmt::format("one of {}", fmt::join(choices, ", ")),
       .limits = fmt::format(R"(, "choices": ["{}"])", fmt::join(choices, R"(", ")"))});
}

void Options::text(const std::string& name, std::string& value, const std::string& help, Role role) {
  const auto read = [&value](const std::string& text) {
    value = text;
    return true;
  };
  add(name, "", help, role,
      {.type = "text", .read = read, .value = [&value] { return AttributeValue(value); }});
}

bool Options::given(const std::string& name) const { return app_->count(name) > 0; }

std::optional<std::string> Options::parse(int argc, const char* const* argv, const std::string& version) {
  const auto refuse = [this](const std::string& why) {
    throw UsageError(fmt::format("{}. Correct it; '{} --help' lists every option.", why, program_));
  };
  try {
    app_->parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return app_->help();
  } catch (const CLI::CallForVersion&) {
    return version + '\n';
  } catch (const CLI::ArgumentMismatch& error) {
    const std::string what = error.what();
    refuse(what.substr(0, what.find(':')) + " needs a value");
  } catch (const CLI::ParseError& error) {
    refuse(error.what());
  }
  for (const std::string& extra : app_->remaining()) {
    if (!extra.starts_with('-')) refuse(fmt::format("unexpected argument '{}'", extra));
    const std::string name = extra.substr(0, extra.find('='));
    const auto nearest = std::ranges::min_element(
        options_, {}, [&](const Option& option) { return distance(option.name, name); });
    refuse(fmt::format("{} is not an option; the nearest one is {}", name, nearest->name));
  }
  for (const Option& option : options_) {
    const std::vector<std::string>& values = app_->get_option(option.name)->results();
    if (values.size() > 1) refuse(option.name + " is given more than once");
    if (!values.empty() && !option.read(values.front()))
      refuse(fmt::format("{}: '{}' cannot be used: it must be {}", option.name, values.front(),
                         option.admissible));
  }
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i], name = word.substr(0, word.find('='));
    const auto option = std::ranges::find(options_, name, &Option::name);
    if (option == options_.end() || option->role != Role::result) continue;
    words_ += (words_.empty() ? "" : " ") + word;
    if (name == word && option->type != "flag") words_ += ' ' + std::string(argv[++i]);
  }
  return {};
}

std::vector<Parameter> Options::parameters() const {
  std::vector<Parameter> result;
  for (const Option& option : options_)
    if (option.role == Role::result) result.push_back({option.name.substr(2), option.value()});
  std::ranges::sort(result, {}, &Parameter::name);
  return result;
}

std::string Options::describe() const {
  std::vector<std::string> each;
  for (const Option& option : options_)
    each.push_back(fmt::format(
        R"({{"name": "{}", "type": "{}", "description": "{}"{}, "affects_results": {}}})",
        option.name.substr(2), option.type, option.help, option.limits, option.role == Role::result));
  return fmt::format("[{}]", fmt::join(each, ",\n"));
}

}  // namespace lorentz
