#include "program/describe.hpp"

#include <cmath>
#include <nlohmann/json.hpp>  // compiles slowly: included here alone

#include "program/stopping_rule.hpp"

namespace lorentz {
namespace {

using Json = nlohmann::ordered_json;

void set_range(Json& schema, const char* type, const Range& range) {
  schema["type"] = type;
  const bool whole = schema["type"] == "integer";
  const auto number = [&](double x) { return whole ? Json(static_cast<std::uint64_t>(x)) : Json(x); };
  schema["minimum"] = number(range.low);
  if (std::isfinite(range.high)) schema["maximum"] = number(range.high);
}

/// Allows a text besides numbers.
void add_text(Json& schema, const std::string& pattern) {
  schema["type"] = {schema["type"], "string"};
  schema["pattern"] = "^(" + pattern + ")$";
}

void set_values(Json& schema, const Option& option, double) { set_range(schema, "number", option.range); }
template <std::unsigned_integral Whole>
  requires(!std::same_as<Whole, bool>)
void set_values(Json& schema, const Option& option, Whole) {
  set_range(schema, "integer", option.range);
}
template <class Number>
void set_values(Json& schema, const Option& option, std::optional<Number>) {
  set_values(schema, option, Number{});
  add_text(schema, option.words.front());
}
/// The program alone checks range and order of the numbers in a text.
void set_values(Json& schema, const Option& option, const std::vector<double>&) {
  set_range(schema, "number", option.range);
  const std::string number = R"(-?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?)";
  add_text(schema, number + "(," + number + ")*");
}
void set_values(Json& schema, const Option&, bool) { schema["type"] = "boolean"; }
void set_values(Json& schema, const Option& option, const std::string&) {
  if (option.words.empty())
    schema["type"] = "string";
  else
    schema["enum"] = option.words;
}

Json schema_of(const Option& option) {
  Json schema;
  std::visit([&](const auto* variable) { set_values(schema, option, *variable); }, option.variable);
  if (!option.required)
    schema["default"] = std::visit([](const auto& value) { return Json(value); }, option.default_value);
  schema["description"] = option.help;
  if (!option.units.empty()) schema["units"] = option.units;
  schema["affects_results"] = option.role == Option::Role::result;
  schema["allowed"] = option.allowed();
  return schema;
}

Json named(const auto& what) {
  return {{"name", what.name}, {"units", what.units}, {"description", what.description}};
}

}  // namespace

std::string describe(const Options& options, const std::string& description,
                     const std::vector<Description>& quantities) {
  Json result{{"program", options.program()},
              {"description", description},
              {"options", {{"type", "object"}, {"additionalProperties", false}}},
              {"quantities", Json::array()}};
  for (const Option& option : options.all()) {
    if (option.name == "--replicas") result["least_replicas"] = StoppingRule::least;
    result["options"]["properties"][option.name.substr(2)] = schema_of(option);
  }
  for (const Description& what : quantities) {
    Json& quantity = result["quantities"].emplace_back(named(what));
    quantity["axes"] = Json::array();
    for (const Axis& axis : what.axes) quantity["axes"].push_back(named(axis));
  }
  return result.dump(1) + '\n';
}

}  // namespace lorentz
