#include "observables/energy_pulse/peak.hpp"

#include <gsl/gsl_multifit_nlinear.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "numerics/gsl.hpp"

namespace lorentz {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr Peak no_peak{nothing, nothing};
constexpr double part_of_maximum = 0.5;   // level of the window
constexpr double least_half_width = 2.5;  // in cells

std::vector<double> running_mean(const std::vector<double>& profile) {
  std::vector<double> means;
  for (std::size_t d = 0; d < profile.size(); ++d) {
    const auto half = static_cast<std::size_t>(std::lround(0.06 * static_cast<double>(d)));
    const std::size_t first = d - half, last = std::min(d + half, profile.size() - 1);
    double sum = 0;
    for (std::size_t cell = first; cell <= last; ++cell) sum += profile[cell];
    means.push_back(sum / static_cast<double>(last - first + 1));
  }
  return means;
}

/// Cells of a window, with sqrt(weight) and distance u from the middle, -1 to 1.
struct Cells {
  std::vector<double> u, root_weight, y;
};

double cubic(const gsl_vector* c, double u) {
  return gsl_vector_get(c, 0) +
         u * (gsl_vector_get(c, 1) + u * (gsl_vector_get(c, 2) + u * gsl_vector_get(c, 3)));
}

// NOLINTBEGIN(misc-const-correctness): the types are those that GSL calls
/// Residuals sqrt(weight) (exp(cubic) - y) of every cell.
int residuals(const gsl_vector* c, void* data, gsl_vector* result) {
  const Cells& cells = *static_cast<const Cells*>(data);
  for (std::size_t i = 0; i < cells.u.size(); ++i)
    gsl_vector_set(result, i, cells.root_weight[i] * (std::exp(cubic(c, cells.u[i])) - cells.y[i]));
  return GSL_SUCCESS;
}

int jacobian(const gsl_vector* c, void* data, gsl_matrix* result) {
  const Cells& cells = *static_cast<const Cells*>(data);
  for (std::size_t i = 0; i < cells.u.size(); ++i) {
    double slope = cells.root_weight[i] * std::exp(cubic(c, cells.u[i]));
    for (std::size_t k = 0; k < 4; ++k, slope *= cells.u[i]) gsl_matrix_set(result, i, k, slope);
  }
  return GSL_SUCCESS;
}
// NOLINTEND(misc-const-correctness)

}  // namespace

std::vector<double> folded(std::span<const double> profile) {
  const std::size_t centre = profile.size() / 2;
  std::vector<double> result{profile[centre]};
  for (std::size_t d = 1; d <= centre; ++d)
    result.push_back(0.5 * (profile[centre - d] + profile[(centre + d) % profile.size()]));
  return result;
}

std::vector<double> odd_part(std::span<const double> profile) {
  const std::size_t centre = profile.size() / 2;
  std::vector<double> result;
  for (std::size_t d = 1; centre + d < profile.size(); ++d)
    result.push_back(0.5 * (profile[centre + d] - profile[centre - d]));
  return result;
}

std::optional<PeakWindow> peak_window(const std::vector<double>& profile) {
  const std::vector<double> y = running_mean(profile);
  const auto top = static_cast<std::size_t>(std::max_element(y.begin() + 1, y.end()) - y.begin());
  const double level = part_of_maximum * y[top];
  if (!(level > 0)) return {};
  std::size_t low = top, high = top;
  while (low > 0 && y[low] > level) --low;
  while (high < y.size() - 1 && y[high] > level) ++high;
  if (y[low] > level || y[high] > level) return {};
  // Linear interpolation between the outermost cell above the level and its neighbour.
  const double left = static_cast<double>(low) + (level - y[low]) / (y[low + 1] - y[low]);
  const double right = static_cast<double>(high) - (level - y[high]) / (y[high - 1] - y[high]);
  return PeakWindow{0.5 * (left + right), std::max(0.5 * (right - left), least_half_width)};
}

Peak fit_peak(const std::vector<double>& profile, const PeakWindow& window) {
  Cells cells;
  const double last = std::min(static_cast<double>(profile.size() - 1), window.middle + window.half_width);
  for (double d = std::ceil(std::max(0.0, window.middle - window.half_width)); d <= last; ++d) {
    const double u = (d - window.middle) / window.half_width;
    cells.u.push_back(u);
    cells.root_weight.push_back(std::sqrt(std::max(0.0, 1 - u * u)));
    cells.y.push_back(profile[static_cast<std::size_t>(d)]);
  }
  if (cells.u.size() < 4) return no_peak;
  const double scale = *std::ranges::max_element(cells.y);
  if (!(scale > 0)) return no_peak;
  for (double& y : cells.y) y /= scale;

  constexpr double tolerance = 1e-12;  // of coefficients, well below the differences of jackknife samples
  constexpr std::size_t limit = 400;
  gsl_multifit_nlinear_fdf problem{residuals, jacobian, nullptr, cells.u.size(), 4, &cells, 0, 0, 0};
  const gsl_multifit_nlinear_parameters parameters = gsl_multifit_nlinear_default_parameters();
  const GslObject<gsl_multifit_nlinear_workspace, gsl_multifit_nlinear_alloc, gsl_multifit_nlinear_free>
  solver(gsl_multifit_nlinear_trust, &parameters, cells.u.size(), std::size_t{4});
  std::array<double, 4> start{0, 0, std::log(part_of_maximum), 0};
  const gsl_vector_view first = gsl_vector_view_array(start.data(), start.size());
  gsl_multifit_nlinear_init(&first.vector, &problem, solver.get());
  int reason = 0;
  gsl_multifit_nlinear_driver(limit, tolerance, 0, 0, nullptr, nullptr, &reason, solver.get());
  const gsl_vector* const fitted = solver.get()->x;
  const double c1 = gsl_vector_get(fitted, 1), c2 = gsl_vector_get(fitted, 2), c3 = gsl_vector_get(fitted, 3);

  // Maximum of the cubic p(u): p'(u) = 0 and p''(u) < 0, in the form without cancellation.
  const double top = c1 / (std::sqrt(c2 * c2 - 3 * c1 * c3) - c2);
  if (!(std::abs(top) < 1)) return no_peak;
  return {window.middle + window.half_width * top, scale * std::exp(cubic(fitted, top))};
}

}  // namespace lorentz
