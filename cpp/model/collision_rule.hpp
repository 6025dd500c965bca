#pragma once

#include <concepts>
#include <cstdint>
#include <string_view>

#include "numerics/random.hpp"

namespace lorentz {

class Elastic;

/// Distribution of (u, U) at a collision, weighted with the flux of particles, that the collision leaves
/// invariant.
enum class InvariantMeasure : std::uint8_t {
  maxwellian,  // exp(-(u^2 + U^2)/2T) [eq. 8]
  unknown,
};

/// What the programs need to know of a collision rule.
struct RuleProperties {
  std::string_view name;         // of --rule
  std::string_view description;  // for --help
  bool conserves_energy;         // u^2 + U^2
  bool conserves_momentum;       // p + P, for sigma < 1
  InvariantMeasure invariant;
  bool kinetic_equation;  // whether the program boltzmann solves its kinetic equation
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

/// A rule derives from Elastic, which has the masses and the scale of w, and is listed in model/rules.hpp. It
/// is constructed from sigma.
template <class Rule>
concept CollisionRule = std::derived_from<Rule, Elastic> && std::constructible_from<Rule, double> &&
                        std::same_as<decltype(Rule::properties), const RuleProperties> &&
                        (DeterministicRule<Rule> || RandomRule<Rule>);

/// A rule that draws the direction of the particle independently of everything else. In a closed chain, that
/// of the first flight is drawn too.
template <class Rule>
concept DrawsDirection = requires(double& u, RandomStream& random) { Rule::draw_direction(u, random); };

}  // namespace lorentz
