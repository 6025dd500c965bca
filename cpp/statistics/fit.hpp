#pragma once

#include <span>

namespace lorentz {

/// y = intercept + slope x.
struct Line {
  double intercept;
  double slope;
};

/// Least squares with equal weights. Throws std::invalid_argument with fewer than two points. Its errors
/// are left to the jackknife, because the points of one run are correlated.
Line fit_line(std::span<const double> x, std::span<const double> y);

/// Exponent of y ~ x^a: the slope of ln y against ln x over the points with from <= x <= to.
double fit_power(std::span<const double> x, std::span<const double> y, double from, double to);

}  // namespace lorentz
