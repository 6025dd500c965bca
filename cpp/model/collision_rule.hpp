#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "model/scatterer_mass.hpp"
#include "numerics/random.hpp"

namespace lorentz {

/// A number on which a rule depends besides sigma: the option --RULE-NAME of every program with --rule.
struct RuleOption {
  std::string_view name;
  std::string_view units;        // "1" for a pure number
  std::string_view description;  // for --help
  double low, high;              // range
};

/// What the programs need to know of a collision rule. Every rule conserves the energy u^2 + U^2, and leaves
/// the measure exp(-(u^2 + U^2)/2T), weighted with the flux of particles, invariant [eq. 8].
struct RuleProperties {
  std::string_view name;                  // of --rule
  std::string_view description;           // for --help
  bool conserves_momentum;                // p + P, for sigma < 1
  std::span<const RuleOption> options{};  // arguments of its constructor, after sigma
  /// Whether collisions at a sigma exchange energy, and not only momenta, of particle and scatterer: then a
  /// gradient of temperature forms between two reservoirs. Without this function the gradient that is
  /// measured decides.
  bool (*conducts)(double sigma, std::span<const double> options) = nullptr;
  bool changes_neighbour = false;  // NeighbourRule
};

/// A rule by name, with the values of its options in their order.
struct RuleChoice {
  std::string_view name;
  std::vector<double> options{};
};

/// rule(u, w, cell) changes the velocity u of a particle and the scaled velocity w of the scatterer of a cell
/// in place; U = w scatterer_scale().
template <class Rule>
concept DeterministicRule =
    requires(const Rule& rule, double& u, double& w, std::uint32_t cell) { rule(u, w, cell); };

/// The same with random numbers, as many as it needs. They are a stream of this collision alone: of the
/// particle and its number of draws in a closed chain, of the cell and its number of collisions in an open
/// one.
template <class Rule>
concept RandomRule = requires(const Rule& rule, double& u, double& w, std::uint32_t cell,
                              RandomStream& random) { rule(u, w, cell, random); };

/// The same for a rule that may also change the scaled velocity of a neighbouring scatterer, which the
/// dynamics choose: left or right with equal probability, at the end of an open chain the one that exists.
/// Pending events do not depend on a scatterer, so no time of arrival changes.
template <class Rule>
concept NeighbourRule =
    requires(const Rule& rule, double& u, double& w, double& neighbour, std::uint32_t cell,
             RandomStream& random) { rule(u, w, neighbour, cell, random); };

template <class Rule>
concept DrawingRule = RandomRule<Rule> || NeighbourRule<Rule>;

/// The rule with this sigma and these values of its options. Throws std::invalid_argument unless -1 <= sigma
/// <= 1.
template <class Rule>
Rule rule_from(double sigma, std::span<const double> options) {
  return [&]<std::size_t... index>(std::index_sequence<index...>) {
    return Rule(sigma, options[index]...);
  }(std::make_index_sequence<Rule::properties.options.size()>());
}

/// A rule derives from ScattererMass, and is listed in model/rules.hpp. It
/// is constructed from sigma and the values of its options.
template <class Rule>
concept CollisionRule =
    std::derived_from<Rule, ScattererMass> &&
    std::same_as<decltype(Rule::properties), const RuleProperties> &&
    requires(double sigma, std::span<const double> options) { rule_from<Rule>(sigma, options); } &&
    (DeterministicRule<Rule> || DrawingRule<Rule>) &&
    NeighbourRule<Rule> == Rule::properties.changes_neighbour;

/// A rule that draws the direction of the particle independently of everything else. In a closed chain, that
/// of the first flight is drawn too.
template <class Rule>
concept DrawsDirection = requires(double& u, RandomStream& random) { Rule::draw_direction(u, random); };

}  // namespace lorentz
