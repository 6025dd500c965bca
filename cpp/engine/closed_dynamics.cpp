#include "engine/closed_dynamics.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "engine/flights.hpp"

namespace lorentz {
namespace {

/// Checked first of all members, so that nothing is built from a phase point that does not fit.
const ClosedChain& checked(const ClosedChain& chain, const PhasePoint& start) {
  if (start.scatterers.size() != chain.cells)
    throw std::invalid_argument("the phase point does not have the chain's number of scatterers");
  return chain;  // NOLINT(bugprone-return-const-ref-from-parameter): copied at once
}

}  // namespace

template void simulate(ClosedDynamics&, double, NoObserver&, const Heartbeat&);

ClosedDynamics::ClosedDynamics(const ClosedChain& chain, const PhasePoint& start, double end_time,
                               const StreamKey& key)
    : chain_(checked(chain, start)),
      rule_(make_rule(chain.rule, chain.sigma)),
      scatterers_(masses(rule_).scaled(start.scatterers)),
      free_flight_(chain, key, start.particles.size()),
      queue_(first_flights(chain, start, rule_, free_flight_), expected_rate(chain, start), end_time) {}

std::vector<double> ClosedDynamics::positions_from_targets(double time) const {
  std::vector<double> positions;
  for (const Flight& flight : queue_.flights())
    positions.push_back(position_from_target(flight, time, chain_.cell_length));
  return positions;
}

std::vector<double> ClosedDynamics::scatterers() const { return masses(rule_).unscaled(scatterers_); }

PhasePoint ClosedDynamics::phase_point(double time) const {
  PhasePoint point{{}, scatterers()};
  for (const Flight& flight : queue_.flights())
    point.particles.push_back({position(flight, time, chain_), flight.velocity, flight.draws});
  return point;
}

Invariants ClosedDynamics::invariants() const {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const double root_mass = masses(rule_).root_mass();
  Invariants sum;
  for (const Flight& flight : queue_.flights()) {
    sum.energy += 0.5 * flight.velocity * flight.velocity;
    sum.momentum += flight.velocity;
    sum.momentum_scale += std::abs(flight.velocity);
  }
  for (const double scatterer : scatterers()) {
    sum.energy += 0.5 * scatterer * scatterer;
    sum.momentum += root_mass * scatterer;
    sum.momentum_scale += root_mass * std::abs(scatterer);
  }
  // At exactly 1 the mass of a scatterer is infinite.
  if (!rule_properties(chain_.rule.name).conserves_momentum || chain_.sigma == 1) sum.momentum = none;
  return sum;
}

}  // namespace lorentz
