#include "program/describe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

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

std::string description_of(const Option& option) {
  std::vector<std::string> types;
  if (!option.is_flag() && !option.is_text())
    types.push_back(quoted(option.is_whole() ? "integer" : "number"));
  if (option.is_flag()) types.push_back(quoted("boolean"));
  if (option.is_text() || option.is_list() || !option.words.empty()) types.push_back(quoted("string"));
  Members members{{"types", array(types)},
                  {"role", quoted(option.role_name())},
                  {"required", option.required ? "true" : "false"}};
  if (!option.units.empty()) members.emplace_back("units", quoted(option.units));
  if (option.has_default()) members.emplace_back("default", json(option.default_value));
  if (!option.rule.empty()) members.emplace_back("rule", quoted(option.rule));
  return object(members);
}

Members named(const auto& what) {
  return {
      {"name", quoted(what.name)}, {"units", quoted(what.units)}, {"description", quoted(what.description)}};
}

}  // namespace

std::string describe(const Options& options, const std::string& description,
                     const std::vector<Description>& quantities) {
  Members result{{"program", quoted(options.program())}, {"description", quoted(description)}};
  Members described_options;
  for (const Option& option : options.all())
    described_options.emplace_back(option.name.substr(2), description_of(option));
  result.emplace_back("options", object(described_options));
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
