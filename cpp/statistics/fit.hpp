#pragma once

#include <span>
#include <vector>

namespace lorentz {

/// The line y = intercept + slope x.
struct Line {
  double intercept;
  double slope;
};

/// Line by least squares with the given weights or, without any, equal ones. Its errors follow from the
/// jackknife, because the points of one run are correlated. Throws std::invalid_argument for fewer than two
/// points.
Line fit_line(std::span<const double> x, std::span<const double> y, std::span<const double> weights = {});

/// Exponent a of y ~ x^a: the slope of ln y against ln x over the points with from <= x <= to.
double fit_power(std::span<const double> x, std::span<const double> y, double from, double to);

/// Slope of y against ln x over the points with from <= x <= to.
double fit_logarithm(std::span<const double> x, std::span<const double> y, double from, double to);

/// Local exponents d ln y / d ln x between neighbouring points; NaN unless y is positive.
std::vector<double> local_exponents(std::span<const double> x, std::span<const double> y);

}  // namespace lorentz
