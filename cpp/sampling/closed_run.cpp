#include "sampling/closed_run.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/closed_start.hpp"
#include "engine/stationary_start.hpp"

namespace lorentz {
namespace {

PhasePoint start(const ClosedParameters& parameters, const StreamKey& key) {
  const ClosedChain chain = parameters.chain();
  if (parameters.fugacity) return stationary_start(chain, parameters.stationary_measure(), key);
  const StartTemperatures temperatures{parameters.temperature, parameters.scatterer_temperature};
  return closed_chain_start(chain, temperatures, parameters.zero_total_momentum, key);
}

/// 0 for no change at all, also if the scale is 0.
double relative(double change, double scale) { return change == 0 ? 0 : std::abs(change) / scale; }

}  // namespace

Study closed_study(const ClosedParameters& parameters, const ClosedTallies& tallies,
                   const std::function<void(ClosedRun&, TallySums&)>& observe, std::vector<Group> groups,
                   const std::string& target) {
  Group& conservation = groups.emplace_back();
  conservation.quantity(tallies, tallies.energy_change);
  conservation.quantity(tallies, tallies.momentum_change);
  const auto sample = [=](const Replica& replica, TallySums& sums) {
    ClosedRun run(parameters, replica);
    run.relax();
    observe(run, sums);
    return run.finish(tallies, sums);
  };
  return {.tallies = tallies, .sample = sample, .groups = std::move(groups), .target = target};
}

ClosedRun::ClosedRun(const ClosedParameters& parameters, const Replica& replica)
    : parameters_(parameters),
      replica_(replica),
      chain_(parameters.chain(), start(parameters, replica.key), parameters.end_time(), replica.key),
      start_(chain_.invariants()),
      longest_clock_(parameters.longest_clock()) {}

std::pair<PhasePoint, std::uint64_t> relaxed_start(const ClosedParameters& parameters,
                                                   const Replica& replica) {
  PhasePoint point = start(parameters, replica.key);
  const double end = parameters.relaxation_time;
  if (end == 0) return {std::move(point), 0};
  ClosedDynamics chain(parameters.chain(), point, end, replica.key);  // a ClosedRun would sum its invariants
  NoObserver nobody;
  simulate(chain, end, nobody, replica.heartbeat);
  return {chain.phase_point(end), chain.events()};
}

double ClosedRun::momentum_control() const {
  const double mean = parameters_.mean_square_momentum(), momentum = start_.momentum;
  return mean > 0 && std::isfinite(momentum) ? momentum * momentum / mean - 1 : 0;
}

std::uint64_t ClosedRun::finish(const ClosedTallies& tallies, TallySums& sums) const {
  const Invariants end = chain_.invariants();
  sums[tallies.energy_change] = relative(end.energy - start_.energy, start_.energy);
  sums[tallies.momentum_change] =
      relative(end.momentum - start_.momentum, std::max(start_.momentum_scale, end.momentum_scale));
  return chain_.events();
}

}  // namespace lorentz
