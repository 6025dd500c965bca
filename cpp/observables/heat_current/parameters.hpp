// For the study "does the paper hold?" only (panel `momentum`); no figure of the paper needs it.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "program/errors.hpp"
#include "sampling/closed_parameters.hpp"

namespace lorentz {

/// Parameters of a record of a closed chain in its stationary state, from which it starts.
struct HeatCurrentParameters : ClosedParameters {
  std::vector<double> times{1, 2, 4, 8, 16, 32, 64};  // over which the current is integrated

  HeatCurrentParameters() {
    ring.scattering.cells = 160;
    temperature = 1;
    fugacity = 1;
    relaxation_time = 0;
    observation_time = 256;
  }

  /// Number of intervals of a record, each as long as the first of `times`; lags(times) are `lags`.
  std::size_t intervals(const std::vector<std::size_t>& lags) const {
    const auto whole = static_cast<std::size_t>(observation_time / times.front() * (1 + 1e-9));
    return std::max(whole, lags.back());  // the last time may be rounded
  }
};

/// Ascending times in units of the first, the interval of a record. Throws UsageError unless they are whole
/// multiples of it.
inline std::vector<std::size_t> lags(const std::vector<double>& times) {
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

/// Declares all of them; every scatterer scatters.
inline void declare(Options& options, HeatCurrentParameters& parameters) {
  declare_without_gamma(options, parameters.ring.scattering);
  options.real(Role::physics, "--cell-length", parameters.ring.cell_length, positive, "length",
               "Distance between scatterers");
  options.real(Role::physics, "--temperature", parameters.temperature, positive, "temperature",
               "Temperature");
  options.real(Role::physics, "--fugacity", *parameters.fugacity, positive, "1/length",
               "z of the flux z exp(-p^2/2T) in the stationary state, from which a run starts");
  options.real(Role::effort, "--observation-time", parameters.observation_time, positive, "time",
               "Time of the record");
  options.ascending_list(Role::output, "--times", parameters.times, positive, "time",
                         "Times over which the current is integrated, multiples of the first");
}

/// Throws UsageError if options that are valid one by one exclude each other.
inline void validate(const HeatCurrentParameters& parameters) {
  validate(static_cast<const ClosedParameters&>(parameters));
  const std::vector<double>& times = parameters.times;
  if (times.back() > parameters.observation_time)
    throw UsageError(
        fmt::format("--times: {} is beyond --observation-time {}. Choose a longer one, or earlier times.",
                    times.back(), parameters.observation_time));
  if (times.size() < 2) throw UsageError("--times has one time: the exponent needs two. Add another.");
  constexpr double most_intervals = 1e8;
  if (parameters.observation_time > most_intervals * times.front())
    throw UsageError(fmt::format(
        "--observation-time, --times: a record would have more than {:g} of the first of --times. Choose a "
        "shorter one, or later times.",
        most_intervals));
}

}  // namespace lorentz
