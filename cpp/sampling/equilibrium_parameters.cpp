#include "sampling/equilibrium_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "program/errors.hpp"

namespace lorentz {

EquilibriumParameters::EquilibriumParameters(std::vector<double> default_times)
    : times(std::move(default_times)) {
  ring.scattering.cells = 160;
  temperature = 1;
  fugacity = 1;
  relaxation_time = 0;
  observation_time = 256;
}

std::size_t EquilibriumParameters::intervals(const std::vector<std::size_t>& lags) const {
  const auto whole = static_cast<std::size_t>(observation_time / times.front() * (1 + 1e-9));
  return std::max(whole, lags.back());  // the last time may be rounded
}

std::vector<std::size_t> lags(const std::vector<double>& times) {
  std::vector<std::size_t> lags;
  for (const double time : times) {
    const double lag = time / times.front();
    if (lag > 1e6 || std::abs(lag - std::round(lag)) > 1e-6 * lag)
      throw UsageError(
          "--times: every time must be a whole multiple of the first, which is the interval of the record, "
          "and at most 1e6 times it. Choose others.");
    lags.push_back(static_cast<std::size_t>(std::lround(lag)));
  }
  return lags;
}

void declare(Options& options, EquilibriumParameters& parameters, const std::string& use) {
  options.integer("--cells", parameters.ring.scattering.cells, {1, 100'000'000}, "Number of cells N");
  options.real("--sigma", parameters.ring.scattering.sigma, {-1, 1}, "1", "Mass ratio (M-m)/(M+m)");
  declare(options, parameters.ring.scattering.rule);
  options.real("--cell-length", parameters.ring.cell_length, positive, "length",
               "Distance between scatterers");
  options.real("--temperature", parameters.temperature, positive, "temperature", "Temperature");
  options.real("--fugacity", *parameters.fugacity, positive, "1/length",
               "z of the flux z exp(-p^2/2T) in the stationary state, from which a run starts");
  options.real("--observation-time", parameters.observation_time, positive, "time", "Time of the record");
  options.ascending_list("--times", parameters.times, positive, "time", use);
}

void validate(const EquilibriumParameters& parameters) {
  validate(static_cast<const ClosedParameters&>(parameters));
  if (parameters.times.back() > parameters.observation_time)
    throw UsageError("--times goes beyond --observation-time. Choose a longer one, or earlier times.");
  constexpr double most_intervals = 1e8;
  if (parameters.observation_time > most_intervals * parameters.times.front())
    throw UsageError(fmt::format(
        "--observation-time, --times: a record would have more than {:g} of the first of --times. Choose a "
        "shorter one, or later times.",
        most_intervals));
}

void require_before_sound_returns(const EquilibriumParameters& parameters, double least) {
  if (parameters.ring.scattering.cells < least)
    throw UsageError(fmt::format(
        "--cells: sound travels around the ring within the last of --times. Choose at least {:.0f} cells, or "
        "earlier times.",
        least));
}

}  // namespace lorentz
