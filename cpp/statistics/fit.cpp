#include "statistics/fit.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace lorentz {

Line fit_line(std::span<const double> x, std::span<const double> y, std::span<const double> weights) {
  if (x.size() < 2 || x.size() != y.size()) throw std::invalid_argument("a line needs two points");
  const auto weight = [&](std::size_t i) { return weights.empty() ? 1 : weights[i]; };
  double sum = 0, mean_x = 0, mean_y = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum += weight(i);
    mean_x += (x[i] - mean_x) * (weight(i) / sum);
    mean_y += (y[i] - mean_y) * (weight(i) / sum);
  }
  double covariance = 0, variance = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    covariance += weight(i) * (x[i] - mean_x) * (y[i] - mean_y);
    variance += weight(i) * (x[i] - mean_x) * (x[i] - mean_x);
  }
  const double slope = covariance / variance;
  return {mean_y - slope * mean_x, slope};
}

double fit_power(std::span<const double> x, std::span<const double> y, double from, double to) {
  std::vector<double> log_x, log_y;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (x[i] < from || x[i] > to) continue;
    log_x.push_back(std::log(x[i]));
    log_y.push_back(std::log(y[i]));
  }
  return fit_line(log_x, log_y).slope;
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

double fit_logarithmic_power(std::span<const double> x, std::span<const double> y, double from,
                             double scale) {
  std::vector<double> logarithm, ratio;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (x[i] < from) continue;
    logarithm.push_back(std::log(x[i] / scale));
    ratio.push_back(y[i] / x[i]);
  }
  return fit_power(logarithm, ratio, logarithm.front(), logarithm.back());
}

std::vector<double> local_exponents(std::span<const double> x, std::span<const double> y) {
  std::vector<double> exponents;
  for (std::size_t i = 0; i + 1 < x.size(); ++i)
    exponents.push_back(y[i] > 0 && y[i + 1] > 0 ? std::log(y[i + 1] / y[i]) / std::log(x[i + 1] / x[i])
                                                 : std::numeric_limits<double>::quiet_NaN());
  return exponents;
}

}  // namespace lorentz
