#include "observables/closed_chain_options.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "program/errors.hpp"

namespace lorentz {

ClosedChainOptions::ClosedChainOptions(Options& options) {
  options.integer("--cells", chain_.cells, {1, 100'000'000}, "Number of cells N");
  options.integer("--particles-per-cell", chain_.particles_per_cell, {1, 100'000'000},
                  "Number of particles per cell n");
  options.real("--sigma", chain_.sigma, {-1, 1}, "Mass ratio (M-m)/(M+m)");
  options.real("--cell-length", chain_.cell_length, positive, "Distance between scatterers");
  options.real("--temperature", temperatures_.particles, positive,
               "Temperature of the particles at the start");
  options.real("--scatterer-temperature", temperatures_.scatterers, non_negative,
               "Temperature of the scatterers at the start; 0: at rest");
  options.flag("--zero-total-momentum", zero_total_momentum_,
               "Shift the particles' momenta at the start so that the total momentum is 0");
  options.real("--relaxation-time", relaxation_time_, non_negative, "Time before the measurement");
  options.real("--observation-time", observation_time_, positive, "Time of the measurement");
}

void ClosedChainOptions::validate() const {
  const std::uint64_t particles = std::uint64_t{chain_.cells} * chain_.particles_per_cell;
  if (particles > 1'000'000'000)
    throw UsageError("--cells times --particles-per-cell exceeds 1e9 particles. Choose a smaller chain.");
  if (!std::isfinite(end_time()))
    throw UsageError("--relaxation-time plus --observation-time overflows. Choose shorter times.");
}

ClosedDynamics ClosedChainOptions::start(std::uint64_t seed, std::uint64_t replica) const {
  return {chain_, closed_chain_start(chain_, temperatures_, zero_total_momentum_, seed, replica), end_time()};
}

Drift drift(const Invariants& before, const Invariants& after) {
  return {std::abs(after.energy - before.energy) / before.energy,
          std::abs(after.momentum - before.momentum) / std::max(before.momentum_scale, after.momentum_scale)};
}

}  // namespace lorentz
