#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace lorentz {

/// Mean of y over the points with low <= x <= high; NaN if there are none.
inline double mean_between(const std::vector<double>& x, std::span<const double> y, double low, double high) {
  double sum = 0, points = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (x[i] < low || x[i] > high) continue;
    sum += y[i];
    points += 1;
  }
  return sum / points;
}

/// x at which y first rises through a level, interpolated linearly in ln x; NaN if there is none.
inline double rise_through(const std::vector<double>& x, std::span<const double> y, double level) {
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    if (y[i] > level || y[i + 1] <= level) continue;
    const double part = (level - y[i]) / (y[i + 1] - y[i]);
    return x[i] * std::pow(x[i + 1] / x[i], part);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace lorentz
