#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

#include "model/rules/elastic.hpp"
#include "model/rules/printed.hpp"
#include "model/rules/random_direction.hpp"
#include "model/rules/reversal.hpp"
#include "model/rules/rotation.hpp"

namespace lorentz {

/// The rules of --rule. The first is the default.
using Rules = std::variant<Elastic, RandomDirection, Reversal, Rotation, Printed>;

namespace rules {

template <CollisionRule... Each>
constexpr std::array<RuleProperties, sizeof...(Each)> properties(std::type_identity<std::variant<Each...>>) {
  return {Each::properties...};
}

inline constexpr auto all = properties(std::type_identity<Rules>());

/// A rule without properties of its own would have those of the rule that it derives from.
consteval bool names_differ() {
  for (const RuleProperties& rule : all)
    for (const RuleProperties& other : all)
      if (&rule != &other && rule.name == other.name) return false;
  return true;
}
static_assert(names_differ(), "two rules have one name: define `properties` in each");

}  // namespace rules

/// Throws std::invalid_argument if no rule has this name.
inline const RuleProperties& rule_properties(std::string_view name) {
  for (const RuleProperties& rule : rules::all)
    if (rule.name == name) return rule;
  throw std::invalid_argument("no collision rule is named " + std::string(name));
}

/// The chosen rule. Throws std::invalid_argument if there is none of this name, if it has another number of
/// options, or unless -1 <= sigma <= 1.
template <std::size_t index = 0>
Rules make_rule(const RuleChoice& choice, double sigma) {
  if constexpr (index < std::variant_size_v<Rules>) {
    if (rules::all[index].name != choice.name) return make_rule<index + 1>(choice, sigma);
    if (rules::all[index].options.size() != choice.options.size())
      throw std::invalid_argument(std::string(choice.name) + " has another number of options");
    return rule_from<std::variant_alternative_t<index, Rules>>(sigma, choice.options);
  } else {
    throw std::invalid_argument("no collision rule is named " + std::string(choice.name));
  }
}

/// The mass of the scatterers.
inline const ScattererMass& masses(const Rules& rule) {
  return std::visit([](const ScattererMass& mass) -> const ScattererMass& { return mass; }, rule);
}

}  // namespace lorentz
