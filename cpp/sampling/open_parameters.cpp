#include "sampling/open_parameters.hpp"

#include <algorithm>
#include <cmath>

#include "engine/open_start.hpp"

namespace lorentz {

OpenChain OpenParameters::chain() const {
  return {scattering.scatterers(cell_length.value_or(1. / scattering.cells)), left, right};
}

PhasePoint OpenParameters::start_point(double age, const StreamKey& key) const {
  if (start == "empty") return empty_start(chain());
  if (start == "warm") return local_equilibrium_start(chain(), left, right, age, key);
  const Reservoir& everywhere = (start == "hot") == (left.temperature > right.temperature) ? left : right;
  return local_equilibrium_start(chain(), everywhere, everywhere, age, key);
}

void declare(Options& options, OpenParameters& parameters, Role start) {
  declare(options, parameters.scattering, non_negative);
  options.real_or_word(Role::physics, "--cell-length", parameters.cell_length, positive, "1/N", "length",
                       "Distance between scatterers");
  declare(options, parameters.left, parameters.right);
  options.choice(start, "--start", parameters.start, {"empty", "warm", "cold", "hot"},
                 "empty: no particles, scatterers at rest; warm: near the stationary state; cold, hot: as in "
                 "equilibrium with the colder, hotter reservoir");
}

void declare(Options& options, StationaryParameters& parameters) {
  declare(options, static_cast<OpenParameters&>(parameters), Role::effort);
  options.real(Role::effort, "--relaxation-time", parameters.relaxation_time, non_negative, "time",
               "Time before the measurement");
  options.real(Role::effort, "--observation-time", parameters.observation_time, positive, "time",
               "Time of the measurement");
}

void validate(const OpenParameters& parameters, double end, const std::string& times) {
  validate(parameters.scattering);
  const OpenChain chain = parameters.chain();
  const auto [cold, hot] = std::minmax(chain.left.temperature, chain.right.temperature);
  require_resolved(chain.cell_length / std::sqrt(hot), end, "--cell-length, " + times);
  // Slow particles accumulate: a few dozen times as many are inside as cross at thermal speed.
  const double stay = std::min(end, 50 * chain.cell_length * chain.cells / std::sqrt(cold));
  require_memory((chain.left.rate + chain.right.rate) * stay, "--nu-left, --nu-right");
}

void validate(const StationaryParameters& parameters) {
  const Window window = parameters.window();
  validate(parameters, window.end, "--relaxation-time, --observation-time");
  require_resolved(parameters.observation_time, window.end, "--relaxation-time, --observation-time");
}

}  // namespace lorentz
