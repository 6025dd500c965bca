#include "statistics/fit.hpp"

#include <gsl/gsl_fit.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace lorentz {

Line fit_line(std::span<const double> x, std::span<const double> y, std::span<const double> weights) {
  if (x.size() < 2 || x.size() != y.size()) throw std::invalid_argument("a line needs two points");
  Line line{};
  double variances[3], squares = 0;  // valid for independent points only
  if (weights.empty())
    gsl_fit_linear(x.data(), 1, y.data(), 1, x.size(), &line.intercept, &line.slope, &variances[0],
                   &variances[1], &variances[2], &squares);
  else
    gsl_fit_wlinear(x.data(), 1, weights.data(), 1, y.data(), 1, x.size(), &line.intercept, &line.slope,
                    &variances[0], &variances[1], &variances[2], &squares);
  return line;
}

double fit_power(std::span<const double> x, std::span<const double> y, double from, double to) {
  std::vector<double> log_y;
  for (const double value : y) log_y.push_back(std::log(value));
  return fit_logarithm(x, log_y, from, to);
}

double fit_logarithm(std::span<const double> x, std::span<const double> y, double from, double to) {
  std::vector<double> log_x, part;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (x[i] < from || x[i] > to) continue;
    log_x.push_back(std::log(x[i]));
    part.push_back(y[i]);
  }
  return fit_line(log_x, part).slope;
}

std::vector<double> local_exponents(std::span<const double> x, std::span<const double> y) {
  std::vector<double> exponents;
  for (std::size_t i = 0; i + 1 < x.size(); ++i)
    exponents.push_back(y[i] > 0 && y[i + 1] > 0 ? std::log(y[i + 1] / y[i]) / std::log(x[i + 1] / x[i])
                                                 : std::numeric_limits<double>::quiet_NaN());
  return exponents;
}

}  // namespace lorentz
