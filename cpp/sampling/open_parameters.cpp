#include "sampling/open_parameters.hpp"

#include <algorithm>
#include <cmath>

#include "engine/open_start.hpp"
#include "sampling/limits.hpp"

namespace lorentz {

OpenChain OpenParameters::chain() const {
  return {.cells = scattering.cells,
          .cell_length = cell_length.value_or(1. / scattering.cells),
          .sigma = scattering.sigma,
          .gamma = scattering.mean_scatterings(),
          .left = left,
          .right = right,
          .rule = scattering.rule.choice()};
}

PhasePoint OpenParameters::start_point(double age, const StreamKey& key) const {
  if (start == "empty") return empty_start(chain());
  if (start == "warm") return local_equilibrium_start(chain(), left, right, age, key);
  const Reservoir& everywhere = (start == "hot") == (left.temperature > right.temperature) ? left : right;
  return local_equilibrium_start(chain(), everywhere, everywhere, age, key);
}

Window StationaryParameters::window() const {
  const double begin = relaxation_time.at(scattering.cells);
  return {begin, begin + observation_time.at(scattering.cells)};
}

void declare(Options& options, OpenParameters& parameters) {
  declare(options, parameters.scattering, non_negative);
  options.real_or_word("--cell-length", parameters.cell_length, positive, "1/N", "length",
                       "Distance between scatterers");
  declare(options, parameters.left, parameters.right);
  options.choice("--start", parameters.start, {"empty", "warm", "cold", "hot"},
                 "empty: no particles, scatterers at rest; warm: near the stationary state; cold, hot: as in "
                 "equilibrium with the colder, hotter reservoir");
}

void declare(Options& options, StationaryParameters& parameters) {
  declare(options, static_cast<OpenParameters&>(parameters));
  options.scaled("--relaxation-time", parameters.relaxation_time, non_negative, "time",
                 "Time before the measurement");
  options.scaled("--observation-time", parameters.observation_time, positive, "time",
                 "Time of the measurement");
}

void validate(const OpenParameters& parameters, double end, const std::string& times) {
  validate(parameters.scattering);
  constexpr double most_particles = 1e9;
  const OpenChain chain = parameters.chain();
  const auto [cold, hot] = std::minmax(chain.left.temperature, chain.right.temperature);
  const double rate = chain.left.rate + chain.right.rate;
  const std::string temperatures = "--temperature-left, --temperature-right";
  const std::string rates = "--nu-left, --nu-right";
  require_within(cold, 1e-300, 1e300, temperatures, "the lowest temperature");
  require_within(rate * end, 0, 1e15, rates + ", " + times, "the number of injected particles");
  require_representable({hot, chain.cell_length, end, rate * end, flights_of_one_clock, temperatures, times});
  require_within(hot * end, 1e-290, 1e300, temperatures + ", " + times,
                 "the temperature times the end of the run");
  if (rate > 0) {
    require_within(rate * cold, 1e-290, 1e300, rates + ", " + temperatures,
                   "the rate times the lowest temperature");
    require_within(rate * hot, 1e-290, 1e300, rates + ", " + temperatures,
                   "the rate times the highest temperature");
  }
  // Slow particles accumulate: a few dozen times as many are inside as cross at thermal speed.
  const double stay = std::min(end, 50 * chain.cell_length * chain.cells / std::sqrt(cold));
  require_within(rate * stay, 0, most_particles, rates, "the number of particles inside");
}

void validate(const StationaryParameters& parameters) {
  const Window window = parameters.window();
  validate(parameters, window.end, "--relaxation-time plus --observation-time");
  require_within(window.end / (window.end - window.begin), 1, flights_of_one_clock,
                 "--relaxation-time, --observation-time",
                 "the end of the run over the time of the measurement");
  require_finite_currents(parameters.chain(), window.end - window.begin, 1);
}

}  // namespace lorentz
