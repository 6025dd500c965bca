#include "statistics/fit.hpp"

#include <gsl/gsl_fit.h>

#include <stdexcept>
#include <vector>

#include "model/portable.hpp"

namespace lorentz {

Line fit_line(std::span<const double> x, std::span<const double> y) {
  if (x.size() < 2 || x.size() != y.size()) throw std::invalid_argument("a line needs two points");
  Line line{};
  double variance_00 = 0, variance_01 = 0, variance_11 = 0, squares = 0;
  gsl_fit_linear(x.data(), 1, y.data(), 1, x.size(), &line.intercept, &line.slope, &variance_00, &variance_01,
                 &variance_11, &squares);
  return line;
}

double fit_power(std::span<const double> x, std::span<const double> y, double from, double to) {
  std::vector<double> log_x, log_y;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (x[i] < from || x[i] > to) continue;
    log_x.push_back(portable::log(x[i]));
    log_y.push_back(portable::log(y[i]));
  }
  return fit_line(log_x, log_y).slope;
}

}  // namespace lorentz
