#pragma once

#include <vector>

#include "model/portable.hpp"
#include "program/options.hpp"
#include "statistics/log_grid.hpp"

namespace lorentz {

/// The options of a logarithmic grid of times that ends with the observation, and of a fit to its last part.
class LogTimesOptions {
 public:
  static constexpr std::size_t points_per_decade = 8;

  /// fit_decades is the default of that option.
  explicit LogTimesOptions(double fit_decades) : fit_decades_(fit_decades) {}

  void declare(Options& options) {
    options.real("--decades", decades_, {1, 15},
                 "Decades of time that the grid spans, up to the observation time");
    options.real("--fit-decades", fit_decades_, {0.25, 15},
                 "Decades of time, the last ones, that are fitted");
  }

  LogGrid grid(double last) const {
    return {last * portable::pow(10, -decades_), decades_, points_per_decade};
  }

  std::vector<double> times(double last) const {
    std::vector<double> points = grid(last).points();
    points.back() = last;
    return points;
  }

  /// First time of the fit, a little less than a point of the grid.
  double fit_from(double last) const { return last * portable::pow(10, -fit_decades_) * (1 - 1e-9); }

 private:
  double decades_ = 6;
  double fit_decades_;
};

}  // namespace lorentz
