#include "boltzmann/panels.hpp"

#include <gsl/gsl_integration.h>
#include <gsl/gsl_sf_legendre.h>

#include <algorithm>
#include <cmath>

#include "numerics/gsl.hpp"

namespace lorentz {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double smallest_phase = 0.5;  // k times half the width of a panel: below, the Gauss rule is used

/// Values of P_0, ..., P_degree at a point, which is clamped to [-1, 1].
VectorXd legendre_polynomials(int degree, double point) {
  VectorXd values(degree + 1);
  gsl_sf_legendre_Pl_array(degree, std::clamp(point, -1.0, 1.0), values.data());
  return values;
}

/// Integrals of P_0, ..., P_(order-1) from -1 to a point: (P_(n+1) - P_(n-1)) / (2n+1).
VectorXd legendre_integrals(int order, double point) {
  const VectorXd values = legendre_polynomials(order, point);
  VectorXd integrals(order);
  integrals[0] = std::clamp(point, -1.0, 1.0) + 1;
  for (Index n = 1; n < order; ++n)
    integrals[n] = (values[n + 1] - values[n - 1]) / static_cast<double>(2 * n + 1);
  return integrals;
}

/// Spherical Bessel functions j_0, ..., j_(size-1) at z > smallest_phase. For n < z the upward recurrence is
/// stable. For n > z the downward one is, which starts with a continued fraction for j_size/j_(size-1) and is
/// normalised by j_0 = sin(z)/z and j_0 - z j_1 = cos(z) (DLMF 10.51, 10.74).
void spherical_bessel(double z, VectorXd& values) {
  const auto size = static_cast<int>(values.size());
  const double sine = std::sin(z), cosine = std::cos(z);
  if (z >= size) {
    values[0] = sine / z;
    if (size > 1) values[1] = (values[0] - cosine) / z;
    for (Index n = 1; n + 1 < size; ++n)
      values[n + 1] = static_cast<double>(2 * n + 1) / z * values[n] - values[n - 1];
    return;
  }
  double ratio = 0;
  for (int n = size + 60; n >= size; --n) ratio = z / (2 * n + 1 - z * ratio);
  double above = ratio, here = 1;  // j_(n+1), j_n up to a factor
  values[size - 1] = here;
  for (Index n = size - 1; n > 0; --n) {
    const double below = static_cast<double>(2 * n + 1) / z * here - above;
    above = here;
    values[n - 1] = here = below;
  }
  const double one = z * here, other = here - z * above;
  values *= (one * sine + other * cosine) / (one * one + other * other);
}

}  // namespace

Panels::Panels(std::vector<double> breaks, int order)
    : breaks_(std::move(breaks)),
      order_(order),
      nodes_(static_cast<Index>(count()) * order),
      weights_(nodes_.size()),
      legendre_(order, order) {
  const GslObject<gsl_integration_fixed_workspace, gsl_integration_fixed_alloc, gsl_integration_fixed_free>
      rule(gsl_integration_fixed_legendre, static_cast<std::size_t>(order), -1, 1, 0, 0);
  const Eigen::Map<const VectorXd> rule_nodes(gsl_integration_fixed_nodes(rule.get()), order);
  const Eigen::Map<const VectorXd> rule_weights(gsl_integration_fixed_weights(rule.get()), order);
  for (std::size_t panel = 0; panel < count(); ++panel) {
    nodes_.segment(first(panel), order) = middle(panel) + half_width(panel) * rule_nodes.array();
    weights_.segment(first(panel), order) = half_width(panel) * rule_weights;
  }
  for (Index i = 0; i < order; ++i)
    for (Index n = 0; n < order; ++n)
      legendre_(n, i) = (static_cast<double>(n) + 0.5) * rule_weights[i] *
                        legendre_polynomials(order - 1, rule_nodes[i])[n];
}

std::size_t Panels::panel(double point) const {
  const auto above = std::upper_bound(breaks_.begin() + 1, breaks_.end() - 1, point);
  return static_cast<std::size_t>(above - breaks_.begin()) - 1;
}

VectorXd Panels::lagrange(std::size_t panel, double point) const {
  return legendre_.transpose() *
         legendre_polynomials(order_ - 1, (point - middle(panel)) / half_width(panel));
}

MatrixXd Panels::interpolation(const VectorXd& points) const {
  MatrixXd matrix = MatrixXd::Zero(points.size(), size());
  for (Index row = 0; row < points.size(); ++row) {
    if (points[row] > end()) continue;
    const std::size_t at = panel(points[row]);
    matrix.row(row).segment(first(at), order_) = lagrange(at, points[row]);
  }
  return matrix;
}

MatrixXd Panels::integration(const VectorXd& points) const {
  MatrixXd matrix = MatrixXd::Zero(points.size(), size());
  for (Index row = 0; row < points.size(); ++row) {
    const std::size_t at = panel(points[row]);
    matrix.row(row).head(first(at)) = weights_.head(first(at));
    const double place = (points[row] - middle(at)) / half_width(at);
    matrix.row(row).segment(first(at), order_) =
        half_width(at) * legendre_.transpose() * legendre_integrals(order_, place);
  }
  return matrix;
}

FourierIntegrals Panels::fourier(const VectorXd& k) const {
  // int_{-1}^{1} P_n(s) exp(i z s) ds = 2 i^n j_n(z): even n are its real part, odd n its imaginary part.
  VectorXd bessel(order_), even(order_), odd(order_);
  const Index rows = k.size();
  MatrixXd even_terms = MatrixXd::Zero(order_, rows), odd_terms = even_terms;
  FourierIntegrals result{MatrixXd(rows, size()), MatrixXd(rows, size()), MatrixXd(rows, size())};
  for (std::size_t panel = 0; panel < count(); ++panel) {
    for (Index row = 0; row < rows; ++row) {
      if (k[row] * half_width(panel) <= smallest_phase) continue;
      spherical_bessel(k[row] * half_width(panel), bessel);
      for (Index n = 0; n < order_; ++n)
        (n % 2 == 0 ? even_terms : odd_terms)(n, row) = (n % 4 < 2 ? 2 : -2) * bessel[n];
    }
    const Eigen::ArrayXd phase = k.array() * middle(panel);
    const Eigen::ArrayXd cosine = half_width(panel) * phase.cos(), sine = half_width(panel) * phase.sin();
    const Eigen::ArrayXXd real = (even_terms.transpose() * legendre_).array();
    const Eigen::ArrayXXd imaginary = (odd_terms.transpose() * legendre_).array();
    result.cosine.middleCols(first(panel), order_) = real.colwise() * cosine - imaginary.colwise() * sine;
    result.sine.middleCols(first(panel), order_) = real.colwise() * sine + imaginary.colwise() * cosine;
  }
  result.cosine_minus_one = result.cosine.rowwise() - weights_.transpose();
  // Where exp(i k p) varies little on a panel, the Gauss rule is accurate to rounding and has no
  // cancellation.
  for (std::size_t panel = 0; panel < count(); ++panel)
    for (Index row = 0; row < rows; ++row) {
      if (k[row] * half_width(panel) > smallest_phase) continue;
      const Eigen::ArrayXd phase = k[row] * nodes_.segment(first(panel), order_).array();
      const Eigen::ArrayXd weights = weights_.segment(first(panel), order_).array();
      result.cosine.row(row).segment(first(panel), order_) = weights * phase.cos();
      result.cosine_minus_one.row(row).segment(first(panel), order_) =
          -2 * weights * (0.5 * phase).sin().square();
      result.sine.row(row).segment(first(panel), order_) = weights * phase.sin();
    }
  return result;
}

std::vector<double> graded_breaks(double smallest, double largest, double ratio) {
  std::vector<double> breaks{0};
  const int steps = std::max(1, static_cast<int>(std::ceil(std::log(largest / smallest) / std::log(ratio))));
  for (int step = steps; step >= 0; --step) breaks.push_back(largest * std::pow(ratio, -step));
  return breaks;
}

}  // namespace lorentz
