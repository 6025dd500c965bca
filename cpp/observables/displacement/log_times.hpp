#pragma once

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "program/errors.hpp"
#include "program/options.hpp"
#include "statistics/log_grid.hpp"

namespace lorentz {

/// Logarithmic grid of times up to the end of the observation, and the range of a fit to its last part.
struct LogTimeParameters {
  static constexpr std::size_t points_per_decade = 8;

  double decades = 6;
  double fit_decades = 1;

  LogGrid grid(double last) const { return {last * std::pow(10, -decades), decades, points_per_decade}; }

  std::vector<double> times(double last) const {
    std::vector<double> points = grid(last).points();
    points.back() = last;
    return points;
  }

  /// First time of the fit, slightly below a grid point, so that rounding does not exclude that point.
  double fit_from(double last) const { return last * std::pow(10, -fit_decades) * (1 - 1e-9); }
};

/// Declares --decades and --fit-decades.
inline void declare(Options& options, LogTimeParameters& parameters) {
  options.real(Role::output, "--decades", parameters.decades, {1, 15}, "1",
               "Decades of time that the grid spans, up to the observation time");
  options.real(Role::output, "--fit-decades", parameters.fit_decades, {0.25, 15}, "1",
               "Number of last decades of time that are fitted");
}

/// Throws UsageError if the fit would begin before the grid does.
inline void validate(const LogTimeParameters& parameters) {
  if (parameters.fit_decades > parameters.decades)
    throw UsageError(fmt::format(
        "--fit-decades {} exceeds --decades {}: the fit would begin before the first time. Choose fewer "
        "decades of the fit, or more of the grid.",
        parameters.fit_decades, parameters.decades));
}

}  // namespace lorentz
