#include "program/describe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "program/stopping_rule.hpp"

namespace lorentz {
namespace {

/// JSON text of an object or of an array, whose members are JSON texts.
using Members = std::vector<std::pair<std::string, std::string>>;

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char character : text) {
    if (character == '"' || character == '\\') result += '\\';
    result += character;
  }
  return result + '"';
}

std::string array(const std::vector<std::string>& values) {
  return fmt::format("[{}]", fmt::join(values, ", "));
}

std::string object(const Members& members) {
  std::string text;
  for (const auto& [name, value] : members)
    text += fmt::format("{}\n{}: {}", text.empty() ? "" : ",", quoted(name), value);
  return fmt::format("{{{}}}", text);
}

std::string json(const AttributeValue& value) {
  const auto* text = std::get_if<std::string>(&value);
  return text ? quoted(*text) : as_text(value);
}

/// Type and range of an option that is no choice. A text besides numbers has a pattern; the program alone
/// checks range and order of the numbers in a list.
Members values_of(const Option& option) {
  if (option.is_flag()) return {{"type", quoted("boolean")}};
  if (option.is_text()) return {{"type", quoted("string")}};
  std::string pattern = option.words.empty() ? "" : option.words.front();
  if (option.is_list()) {
    const std::string number = R"(-?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?)";
    pattern = fmt::format("{}(,{})*", number, number);
  }
  const std::string type = quoted(option.is_whole() ? "integer" : "number");
  Members members{{"type", pattern.empty() ? type : array({type, quoted("string")})},
                  {"minimum", option.end(option.range.low)},
                  {"maximum", option.end(option.range.high)}};
  if (!pattern.empty()) members.emplace_back("pattern", quoted("^(" + pattern + ")$"));
  return members;
}

std::string schema_of(const Option& option) {
  std::vector<std::string> choices;
  for (const std::string& word : option.words) choices.push_back(quoted(word));
  Members schema =
      option.is_text() && !choices.empty() ? Members{{"enum", array(choices)}} : values_of(option);
  if (!option.required) schema.emplace_back("default", json(option.default_value));
  schema.emplace_back("description", quoted(option.help));
  if (!option.units.empty()) schema.emplace_back("units", quoted(option.units));
  schema.emplace_back("affects_results", option.role == Option::Role::result ? "true" : "false");
  schema.emplace_back("allowed", quoted(option.allowed()));
  return object(schema);
}

Members named(const auto& what) {
  return {
      {"name", quoted(what.name)}, {"units", quoted(what.units)}, {"description", quoted(what.description)}};
}

}  // namespace

std::string describe(const Options& options, const std::string& description,
                     const std::vector<Description>& quantities) {
  Members result{{"program", quoted(options.program())}, {"description", quoted(description)}}, properties;
  for (const Option& option : options.all()) {
    if (option.name == "--replicas")
      result.emplace_back("least_replicas", fmt::format("{}", StoppingRule::least));
    properties.emplace_back(option.name.substr(2), schema_of(option));
  }
  result.emplace_back("options", object({{"type", quoted("object")},
                                         {"additionalProperties", "false"},
                                         {"properties", object(properties)}}));
  std::vector<std::string> described;
  for (const Description& what : quantities) {
    std::vector<std::string> axes;
    for (const Axis& axis : what.axes) axes.push_back(object(named(axis)));
    Members quantity = named(what);
    quantity.emplace_back("axes", array(axes));
    described.push_back(object(quantity));
  }
  result.emplace_back("quantities", array(described));
  return object(result) + '\n';
}

}  // namespace lorentz
