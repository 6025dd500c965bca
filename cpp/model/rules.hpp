#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

#include "model/rules/elastic.hpp"
#include "model/rules/random_direction.hpp"

namespace lorentz {

/// The rules of --rule. The first is the default.
using Rules = std::variant<Elastic, RandomDirection>;

namespace rules {

template <CollisionRule... Each>
constexpr std::array<RuleProperties, sizeof...(Each)> properties(std::type_identity<std::variant<Each...>>) {
  return {Each::properties...};
}

inline constexpr auto all = properties(std::type_identity<Rules>());

/// A rule without properties of its own would have those of Elastic.
consteval bool names_differ() {
  for (const RuleProperties& one : all)
    for (const RuleProperties& other : all)
      if (&one != &other && one.name == other.name) return false;
  return true;
}
static_assert(names_differ(), "two rules have one name: define `properties` in each");

}  // namespace rules

/// Throws std::invalid_argument if no rule has this name.
inline const RuleProperties& rule_properties(std::string_view name) {
  for (const RuleProperties& each : rules::all)
    if (each.name == name) return each;
  throw std::invalid_argument("no collision rule is named " + std::string(name));
}

/// The rule of this name. Throws std::invalid_argument if there is none, or unless -1 <= sigma <= 1.
template <std::size_t index = 0>
Rules make_rule(std::string_view name, double sigma) {
  if constexpr (index < std::variant_size_v<Rules>) {
    if (rules::all[index].name != name) return make_rule<index + 1>(name, sigma);
    return std::variant_alternative_t<index, Rules>(sigma);
  } else {
    throw std::invalid_argument("no collision rule is named " + std::string(name));
  }
}

/// The part with the masses and the scale of w, which every rule has.
inline const Elastic& masses(const Rules& rule) {
  return std::visit([](const auto& each) -> const Elastic& { return each; }, rule);
}

}  // namespace lorentz
