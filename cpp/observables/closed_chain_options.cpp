#include "observables/closed_chain_options.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/collision.hpp"
#include "observables/physics_options.hpp"
#include "program/errors.hpp"

namespace lorentz {

void add_chain_options(Options& options, ClosedChain& chain) {
  add_scattering_options(options, chain.cells, chain.sigma, chain.gamma, positive);
  options.integer("--particles-per-cell", chain.particles_per_cell, {1, 100'000'000},
                  "Number of particles per cell n");
  options.real("--cell-length", chain.cell_length, positive, "Distance between scatterers");
}

void require_possible(const ClosedChain& chain, double hottest, double end_time, double most_flights,
                      const std::string& temperatures, const std::string& times) {
  const std::uint64_t particles = std::uint64_t{chain.cells} * chain.particles_per_cell;
  if (particles > 1'000'000'000)
    throw UsageError("--cells times --particles-per-cell exceeds 1e9 particles. Choose a smaller chain.");
  require_representable({hottest, chain.cell_length, end_time, static_cast<double>(particles + chain.cells),
                         most_flights, temperatures, times});
}

void ClosedChainOptions::declare(Options& options) {
  add_chain_options(options, chain_);
  options.real("--temperature", temperatures_.particles, positive,
               "Temperature of the particles at the start");
  options.real("--scatterer-temperature", temperatures_.scatterers, non_negative,
               "Temperature of the scatterers at the start; 0: at rest");
  options.flag("--zero-total-momentum", zero_total_momentum_,
               "Shift the particles' momenta at the start so that the total momentum is 0");
  options.real("--relaxation-time", relaxation_time_, non_negative, "Time before the measurement");
  options.real("--observation-time", observation_time_, positive, "Time of the measurement");
}

void ClosedChainOptions::declare_random_direction(Options& options) {
  options.flag("--random-direction", chain_.random_direction,
               "Draw the direction of a particle after every collision");
}

void ClosedChainOptions::validate() const {
  require_possible(chain_, hottest(), end_time(), flights_of_a_year, "--temperature, --scatterer-temperature",
                   "--relaxation-time plus --observation-time");
}

ClosedDynamics ClosedChainOptions::start(const StreamKey& key) const {
  return {chain_, closed_chain_start(chain_, temperatures_, zero_total_momentum_, key), end_time(), key};
}

double ClosedChainOptions::mean_square_momentum() const {
  if (zero_total_momentum_) return 0;
  const double root_mass = CollisionRule(chain_.sigma).root_mass();
  return chain_.particles() * temperatures_.particles +
         chain_.cells * temperatures_.scatterers * root_mass * root_mass;
}

double ClosedChainOptions::mean_energy() const {
  if (zero_total_momentum_) return std::numeric_limits<double>::quiet_NaN();
  return 0.5 * (chain_.particles() * temperatures_.particles + chain_.cells * temperatures_.scatterers);
}

double ClosedReplica::energy_control() const {
  const double mean = options_.mean_energy();
  return std::isnan(mean) ? 0 : start_.energy / mean - 1;
}

double ClosedReplica::momentum_control() const {
  const double mean = options_.mean_square_momentum(), momentum = start_.momentum;
  return mean > 0 && std::isfinite(momentum) ? momentum * momentum / mean - 1 : 0;
}

ReplicaRecord ClosedReplica::record(std::vector<double> sums) const {
  const Invariants end = chain_.invariants();
  const auto relative = [](double change, double scale) {
    return change == 0 ? 0 : std::abs(change) / scale;
  };
  sums.push_back(relative(end.energy - start_.energy, start_.energy));
  sums.push_back(
      relative(end.momentum - start_.momentum, std::max(start_.momentum_scale, end.momentum_scale)));
  return {std::move(sums), chain_.events()};
}

namespace {

Records without_drifts(const Records& records) {
  const std::size_t width = records.width() - 2;
  Records result(width);
  for (std::size_t i = 0; i < records.size(); ++i) result.append(records[i].first(width));
  return result;
}

Results drift_results(const Records& records) {
  return estimate(
      records,
      {{"energy_drift", "1", "Mean over replicas of |change of total energy| / total energy"},
       {"momentum_drift", "1", "Mean over replicas of |change of total momentum| / sum of all |momenta|"}},
      [](std::span<const double> sums) { return std::vector<double>(sums.end() - 2, sums.end()); });
}

}  // namespace

std::function<Results(const Records&)> with_drift(std::function<Results(const Records&)> summarise) {
  return [summarise = std::move(summarise)](const Records& records) {
    Results results = summarise(without_drifts(records));
    for (Quantity& quantity : drift_results(records)) results.push_back(std::move(quantity));
    return results;
  };
}

}  // namespace lorentz
