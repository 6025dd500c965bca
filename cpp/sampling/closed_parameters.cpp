#include "sampling/closed_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/rules/elastic.hpp"
#include "program/errors.hpp"

namespace lorentz {
ClosedChain ClosedParameters::chain() const { return ring.chain(); }

bool ClosedParameters::conserves_momentum() const {
  return ring.scattering.rule.properties().conserves_momentum && ring.scattering.sigma < 1;
}

StationaryMeasure ClosedParameters::stationary_measure() const {
  const double whole_run = 0.01 * ring.cell_length / end_time();
  return {fugacity.value(), temperature, std::min(whole_run, 1e-3 * std::sqrt(temperature))};
}

double ClosedParameters::hottest() const { return std::max(temperature, scatterer_temperature); }

double ClosedParameters::mean_square_momentum() const {
  if (zero_total_momentum) return 0;
  const ClosedChain chain = this->chain();
  const double root_mass = Elastic(chain.sigma).root_mass();
  return chain.particles() * temperature + chain.cells * scatterer_temperature * root_mass * root_mass;
}

double ClosedParameters::longest_clock() const { return 0x1p32 * ring.cell_length / std::sqrt(hottest()); }

void declare(Options& options, ClosedParameters& parameters, Role observation) {
  declare(options, parameters.ring);
  options.real(Role::physics, "--temperature", parameters.temperature, positive, "temperature",
               "Temperature of the particles at the start");
  options.real(Role::physics, "--scatterer-temperature", parameters.scatterer_temperature, non_negative,
               "temperature", "Temperature of the scatterers at the start; 0: at rest");
  options.flag(Role::physics, "--zero-total-momentum", parameters.zero_total_momentum,
               "Shift the particles' momenta at the start so that the total momentum is 0");
  options.real(Role::physics, "--relaxation-time", parameters.relaxation_time, non_negative, "time",
               "Time before the measurement");
  options.real(observation, "--observation-time", parameters.observation_time, positive, "time",
               "Time of the measurement");
}

void validate(const ClosedParameters& parameters) {
  validate(parameters.ring.scattering);
  const ClosedChain chain = parameters.chain();
  const RuleProperties& rule = parameters.ring.scattering.rule.properties();
  if (parameters.fugacity)
    require_memory(chain.cells * mean_number(chain, parameters.stationary_measure()),
                   "--cells, --fugacity, --cell-length");
  else
    require_memory(1.0 * chain.cells * chain.particles_per_cell, "--cells, --particles-per-cell");
  if (parameters.zero_total_momentum && !rule.conserves_momentum)
    throw UsageError(
        fmt::format("--zero-total-momentum: the rule {} does not conserve momentum, so that it does not "
                    "remain zero. Leave it out, or choose another --rule.",
                    rule.name));
}

}  // namespace lorentz
