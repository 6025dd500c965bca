#include "program/options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <sstream>
#include <system_error>
#include <utility>

#include "program/config_file.hpp"
#include "program/errors.hpp"
#include "program/nearest_name.hpp"
#include "program/standard_streams.hpp"

namespace lorentz {

using nlohmann::json;

/// What distinguishes one option from another; Options::add() puts in what all have in common.
struct Option {
  json description;                              // an element of describe()
  std::string admissible;                        // "a number at least 0"; empty for any text
  std::function<bool(const std::string&)> read;  // sets the value; false if the text is not admissible
  std::function<AttributeValue()> recorded;
  std::string name = {};
  bool given = false;
};

namespace {

template <class Number>
json numeric(const std::string& type, const Range<Number>& range, const std::string& units) {
  json description = {{"type", type}, {"units", units}};
  if (range.bounded_below()) description[range.open_below ? "exclusive_minimum" : "minimum"] = range.low;
  if (range.bounded_above()) description["maximum"] = range.high;
  return description;
}

template <class Number>
std::string interval(const Range<Number>& range) {
  if (range.bounded_above())
    return fmt::format("in {}{}, {}]", range.open_below ? '(' : '[', range.low, range.high);
  if (!range.bounded_below()) return "that is finite";
  return fmt::format("{} {}", range.open_below ? "greater than" : "at least", range.low);
}

template <class Number>
std::string number_in(const Range<Number>& range) {
  return (std::is_integral_v<Number> ? "a whole number " : "a number ") + interval(range);
}

template <class Number>
Option number(Number& value, Range<Number> range, const std::string& units) {
  constexpr bool whole = std::is_integral_v<Number>;
  using Recorded = std::conditional_t<whole, std::uint64_t, double>;  // whole numbers in one width
  return {numeric(whole ? "integer" : "number", range, units), number_in(range),
          [&value, range](const std::string& text) { return read_number(text, range, value); },
          [&value] { return AttributeValue(Recorded{value}); }};
}

/// The number is recorded as floating point, also where it is whole.
template <class Number>
Option number_or_word(std::optional<Number>& value, Range<Number> range, const std::string& word,
                      const std::string& units) {
  const auto read = [&value, range, word](const std::string& text) {
    if (text != word) return read_number(text, range, value.emplace());
    value.reset();
    return true;
  };
  const auto recorded = [&value, word] {
    return value ? AttributeValue(static_cast<double>(*value)) : AttributeValue(word);
  };
  const std::string type = std::is_integral_v<Number> ? "integer or word" : "number or word";
  Option option{numeric(type, range, units), number_in(range) + ", or " + word, read, recorded};
  option.description["word"] = word;
  return option;
}

std::string as_text(const AttributeValue& value) {
  return std::visit([](const auto& each) { return fmt::format("{}", each); }, value);
}

/// The value as an option of this type reads it; where no string or array is admissible, as the literal.
const std::string& text_for(const std::string& type, const ConfigEntry& entry) {
  const bool word = type != "number" && type != "integer" && type != "flag";
  const bool fits = entry.form == ConfigEntry::Form::string ? word : type == "numbers";
  return fits ? entry.text : entry.literal;
}

}  // namespace

Options::Options(std::string program, const std::string& description)
    : program_(std::move(program)), app_(std::make_unique<CLI::App>(description, program_)) {
  app_->add_option("--config", "Read options from a TOML file (keys without the dashes)")
      ->type_name("")
      ->take_all();  // parse() refuses an option given twice
  app_->set_version_flag("--version", std::string{}, "Print version and build id, then exit");
  app_->get_formatter()->column_width(36);
  app_->allow_extras();  // parse() refuses them, with the name that is nearest
}

Options::~Options() = default;

void Options::add(const std::string& name, const std::string& help, Role role, Option option) {
  const AttributeValue preset = option.recorded();
  option.name = name;
  option.description["name"] = name.substr(2);
  option.description["description"] = help;
  option.description["default"] = std::visit([](const auto& value) { return json(value); }, preset);
  option.description["affects_results"] = role == Role::result;
  const std::string units = option.description.value("units", "1");
  std::string text = help;
  if (units != "1") text += fmt::format(" [{}]", units);
  if (!option.admissible.empty())
    text += fmt::format(" ({}; default {})", option.admissible, as_text(preset));
  if (option.description["type"] == "flag")
    app_->add_flag(name, help);
  else
    app_->add_option(name, CLI::callback_t{}, text)->type_name("")->take_all();
  options_.push_back(std::move(option));
}

void Options::real(const std::string& name, double& value, Range<double> range, const std::string& units,
                   const std::string& help, Role role) {
  add(name, help, role, number(value, range, units));
}

void Options::integer(const std::string& name, std::uint32_t& value, Range<std::uint32_t> range,
                      const std::string& help, Role role) {
  add(name, help, role, number(value, range, "1"));
}

void Options::integer(const std::string& name, std::uint64_t& value, Range<std::uint64_t> range,
                      const std::string& help, Role role) {
  add(name, help, role, number(value, range, "1"));
}

void Options::real_or_word(const std::string& name, std::optional<double>& value, Range<double> range,
                           const std::string& word, const std::string& units, const std::string& help,
                           Role role) {
  add(name, help, role, number_or_word(value, range, word, units));
}

void Options::integer_or_word(const std::string& name, std::optional<std::uint32_t>& value,
                              Range<std::uint32_t> range, const std::string& word, const std::string& help,
                              Role role) {
  add(name, help, role, number_or_word(value, range, word, "1"));
}

void Options::scaled(const std::string& name, Scaled& value, Range<double> range, char symbol,
                     const std::string& units, const std::string& help, Role role) {
  const auto read = [&value, range, symbol](const std::string& text) {
    return read_polynomial(text, range, symbol, value);
  };
  const auto recorded = [&value, symbol] {
    const auto& [constant, linear, quadratic] = value.coefficients;
    return linear == 0 && quadratic == 0 ? AttributeValue(constant) : AttributeValue(as_text(value, symbol));
  };
  add(name, help, role,
      {numeric(fmt::format("number or polynomial in {}", symbol), range, units),
       fmt::format("{0}, or a sum of such, each alone or followed by {1} or {1}^2", number_in(range), symbol),
       read, recorded});
}

void Options::ascending_list(const std::string& name, std::vector<double>& values, Range<double> range,
                             const std::string& units, const std::string& help, Role role) {
  const auto read = [&values, range](const std::string& text) {
    values.clear();
    std::istringstream items(text + ',');  // getline passes over an empty item after the last comma
    for (std::string item; std::getline(items, item, ',');) {
      double value = 0;
      if (!read_number(item, range, value) || (!values.empty() && value <= values.back())) return false;
      values.push_back(value);
    }
    return true;
  };
  const auto recorded = [&values] { return AttributeValue(fmt::format("{}", fmt::join(values, ","))); };
  add(name, help, role,
      {numeric("numbers", range, units),
       fmt::format("numbers {}, ascending, separated by commas", interval(range)), read, recorded});
}

void Options::flag(const std::string& name, bool& value, const std::string& help, Role role) {
  const auto read = [&value](const std::string& text) {
    value = text == "true";
    return value || text == "false";
  };
  add(name, help, role,
      {{{"type", "flag"}}, "true or false", read, [&value] { return AttributeValue(value); }});
}

void Options::choice(const std::string& name, std::string& value, const std::vector<std::string>& choices,
                     const std::string& help, Role role) {
  const auto read = [&value, choices](const std::string& text) {
    value = text;
    return std::ranges::find(choices, text) != choices.end();
  };
  add(name, help, role,
      {{{"type", "choice"}, {"choices", choices}},
       fmt::format("one of {}", fmt::join(choices, ", ")),
       read,
       [&value] { return AttributeValue(value); }});
}

void Options::text(const std::string& name, std::string& value, const std::string& help, Role role) {
  const auto read = [&value](const std::string& text) {
    value = text;
    return true;
  };
  add(name, help, role, {{{"type", "text"}}, "", read, [&value] { return AttributeValue(value); }});
}

bool Options::given(const std::string& name) const {
  return std::ranges::any_of(options_,
                             [&](const Option& option) { return option.given && option.name == name; });
}

void Options::refuse(const std::string& why) const {
  throw UsageError(fmt::format("{}. Correct it; '{} --help' lists every option.", why, program_));
}

std::string Options::nearest(const std::string& name) const {
  std::vector<std::string> names;
  for (const Option& option : options_) names.push_back(option.name);
  return nearest_name("--" + name, names);
}

void Options::refuse_unknown(const std::string& word) const {
  if (!word.starts_with('-')) refuse(fmt::format("'{}' is no option and belongs to none", word));
  const std::string name = word.substr(0, word.find('='));
  refuse(fmt::format("no option has the name {}; the nearest one is {}", name,
                     nearest(name.substr(std::min(name.size(), name.find_first_not_of('-'))))));
}

void Options::read(Option& option, const std::string& text, const std::string& place) {
  option.given = option.read(text);
  if (!option.given)
    refuse(
        fmt::format("{}{}: '{}' cannot be used: it must be {}", place, option.name, text, option.admissible));
}

void Options::read_file(const std::string& path) {
  for (const ConfigEntry& entry : read_config_file(path)) {
    const auto option = std::ranges::find_if(
        options_, [&](const Option& each) { return each.description["name"] == entry.key; });
    if (option == options_.end())
      refuse(fmt::format("{}: no option has the name '{}'; the nearest one is '{}'", entry.place, entry.key,
                         nearest(entry.key).substr(2)));
    if (option->description["type"] == "text" && entry.form != ConfigEntry::Form::string)
      refuse(fmt::format("{}: {}: '{}' cannot be used: it must be a string", entry.place, option->name,
                         entry.literal));
    read(*option, text_for(option->description["type"], entry), entry.place + ": ");
  }
}

const std::string* Options::argument(const std::string& name) const {
  const std::vector<std::string>& values = app_->get_option(name)->results();
  if (values.size() > 1) refuse(name + " is given more than once");
  return values.empty() ? nullptr : &values.front();
}

bool Options::parse(int argc, const char* const* argv, const std::string& version_text) {
  for (const std::string word : std::span(argv, static_cast<std::size_t>(argc)))
    if (word.starts_with("--") && word.find('=') + 1 == word.size())  // CLI11 would take the next word
      refuse(fmt::format("{} is followed by nothing", word));
  try {
    app_->parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    print(app_->help());
    return false;
  } catch (const CLI::CallForVersion&) {
    print(version_text + '\n');
    return false;
  } catch (const CLI::ArgumentMismatch& error) {
    const std::string what = error.what();
    refuse(what.substr(0, what.find(':')) + " needs a value");
  } catch (const CLI::ParseError& error) {
    refuse(error.what());
  }
  for (const std::string& extra : app_->remaining()) refuse_unknown(extra);
  if (const std::string* path = argument("--config")) read_file(*path);
  for (Option& option : options_)
    if (const std::string* text = argument(option.name)) read(option, *text, "");
  return true;
}

void Options::require_not_configuration(const std::string& path) const {
  const std::string* configuration = argument("--config");
  std::error_code unknown;  // there may be no file of that name yet
  if (configuration && std::filesystem::equivalent(*configuration, path, unknown))
    throw UsageError(fmt::format(
        "'{}' is the configuration file, which the run would replace or remove. Choose another --output.",
        path));
}

std::vector<Parameter> Options::parameters() const {
  std::vector<Parameter> result;
  for (const Option& option : options_)
    if (option.description["affects_results"]) result.push_back({option.name.substr(2), option.recorded()});
  std::ranges::sort(result, [](const Parameter& a, const Parameter& b) { return a.name < b.name; });
  return result;
}

json Options::describe() const {
  json result = json::array();
  for (const Option& option : options_) result.push_back(option.description);
  return result;
}

std::string as_text(const std::vector<Parameter>& parameters) {
  std::string text;
  for (const Parameter& each : parameters) text += fmt::format("{} = {}\n", each.name, as_text(each.value));
  return text;
}

}  // namespace lorentz
