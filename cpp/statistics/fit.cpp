#include "statistics/fit.hpp"

#include <gsl/gsl_fit.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <array>
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

Maximum fit_maximum(std::span<const double> x, std::span<const double> y) {
  if (x.size() < 3 || x.size() != y.size()) throw std::invalid_argument("a parabola needs three points");
  // Normal equations in powers of x - centre, solved by moments; the grid is short and regular.
  const double centre = gsl_stats_mean(x.data(), 1, x.size());
  std::array<double, 5> power_sums{};
  std::array<double, 3> moments{};
  for (std::size_t i = 0; i < x.size(); ++i) {
    double power = 1;
    for (std::size_t k = 0; k < power_sums.size(); ++k, power *= x[i] - centre) {
      power_sums[k] += power;
      if (k < moments.size()) moments[k] += power * y[i];
    }
  }
  std::array<double, 9> matrix{power_sums[0], power_sums[1], power_sums[2], power_sums[1], power_sums[2],
                               power_sums[3], power_sums[2], power_sums[3], power_sums[4]};
  gsl_matrix_view a = gsl_matrix_view_array(matrix.data(), 3, 3);
  gsl_vector_view c = gsl_vector_view_array(moments.data(), 3);
  gsl_linalg_HH_svx(&a.matrix, &c.vector);  // moments become the coefficients
  const auto height = [&](double shift) { return moments[0] + shift * (moments[1] + shift * moments[2]); };
  const double low = x.front() - centre, high = x.back() - centre;
  const double highest = moments[2] < 0               ? std::clamp(-moments[1] / (2 * moments[2]), low, high)
                         : height(low) > height(high) ? low
                                                      : high;
  return {centre + highest, height(highest)};
}

}  // namespace lorentz
