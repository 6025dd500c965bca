#include "sampling/closed_parameters.hpp"

#include <algorithm>
#include <cmath>

#include "model/collision.hpp"
#include "program/errors.hpp"
#include "sampling/limits.hpp"

namespace lorentz {
namespace {

/// Throws UsageError unless the stationary start can be sampled and its run be simulated.
void require_stationary(const ClosedParameters& parameters) {
  const ClosedChain chain = parameters.chain();
  const StationaryMeasure measure = parameters.stationary_measure();
  const double relative = measure.slowest / std::sqrt(measure.temperature);
  if (relative > 1)
    throw UsageError(
        "--slowest exceeds the thermal momentum sqrt(--temperature): most particles would be missing. Choose "
        "a smaller one, or a longer run.");
  require_within(relative, 1e-100, 1, "--slowest, --temperature", "the least momentum over the thermal one");
  const double particles = chain.cells * mean_number(chain, measure);
  if (particles > 1e9)
    throw UsageError(
        "--fugacity: more than 1e9 particles would be needed. Choose a smaller one, or fewer --cells.");
  require_representable({parameters.temperature, chain.cell_length, parameters.end_time(),
                         particles + chain.cells, flights_of_a_year, "--temperature", "--observation-time"});
}

}  // namespace

ClosedChain ClosedParameters::chain() const {
  ClosedChain chain = ring.chain();
  chain.random_direction = random_direction;
  return chain;
}

StationaryMeasure ClosedParameters::stationary_measure() const {
  return {fugacity.value(), temperature, slowest.value_or(0.01 * ring.cell_length / end_time())};
}

double ClosedParameters::hottest() const { return std::max(temperature, scatterer_temperature); }

double ClosedParameters::mean_square_momentum() const {
  if (zero_total_momentum) return 0;
  const ClosedChain chain = this->chain();
  const double root_mass = CollisionRule(chain.sigma).root_mass();
  return chain.particles() * temperature + chain.cells * scatterer_temperature * root_mass * root_mass;
}

std::optional<double> ClosedParameters::mean_energy() const {
  if (zero_total_momentum) return {};
  const ClosedChain chain = this->chain();
  return 0.5 * (chain.particles() * temperature + chain.cells * scatterer_temperature);
}

double ClosedParameters::longest_clock() const { return 0x1p32 * ring.cell_length / std::sqrt(hottest()); }

double ClosedParameters::thermal_flight() const { return ring.cell_length / std::sqrt(temperature); }

void declare(Options& options, ClosedParameters& parameters) {
  declare(options, parameters.ring);
  options.real("--temperature", parameters.temperature, positive, "temperature",
               "Temperature of the particles at the start");
  options.real("--scatterer-temperature", parameters.scatterer_temperature, non_negative, "temperature",
               "Temperature of the scatterers at the start; 0: at rest");
  options.flag("--zero-total-momentum", parameters.zero_total_momentum,
               "Shift the particles' momenta at the start so that the total momentum is 0");
  options.real("--relaxation-time", parameters.relaxation_time, non_negative, "time",
               "Time before the measurement");
  options.real("--observation-time", parameters.observation_time, positive, "time",
               "Time of the measurement");
}

void declare_random_direction(Options& options, ClosedParameters& parameters) {
  options.flag("--random-direction", parameters.random_direction,
               "Draw the direction of a particle after every collision");
}

void declare_stationary_start(Options& options, ClosedParameters& parameters) {
  options.real("--fugacity", parameters.fugacity.emplace(1), positive, "1/length",
               "z of the flux z exp(-p^2/2T) in the stationary state, from which a run starts");
  options.real_or_word("--slowest", parameters.slowest, positive, "auto", "momentum",
                       "Least momentum of a particle at the start; auto: 0.01 cell lengths in the whole run");
}

void validate(const ClosedParameters& parameters) {
  require_probability(parameters.ring.scattering.gamma, parameters.ring.scattering.cells);
  if (parameters.fugacity) return require_stationary(parameters);
  require_possible(parameters.chain(), parameters.hottest(), parameters.end_time(), flights_of_a_year,
                   "--temperature, --scatterer-temperature", "--relaxation-time plus --observation-time");
}

}  // namespace lorentz
