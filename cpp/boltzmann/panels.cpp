#include "boltzmann/panels.hpp"

#include <gsl/gsl_sf_bessel.h>
#include <gsl/gsl_sf_legendre.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/portable.hpp"

namespace lorentz {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct GaussRule {
  VectorXd nodes, weights;  // on [-1, 1]
};

/// P_0...P_degree at a point of [-1, 1].
VectorXd legendre_polynomials(int degree, double point) {
  VectorXd values(degree + 1);
  gsl_sf_legendre_Pl_array(degree, std::clamp(point, -1.0, 1.0), values.data());
  return values;
}

/// By Newton's method. GSL's rules of other than its tabulated orders would begin at the C library's cosine,
/// see model/portable.hpp.
GaussRule gauss_rule(int order) {
  GaussRule rule{VectorXd(order), VectorXd(order)};
  for (Index i = 0; i < order; ++i) {
    double x = -portable::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (order + 0.5));
    double slope = 0;                       // of P_order
    for (int step = 0; step < 5; ++step) {  // the error, at most 0.01 at first, is squared each time
      const VectorXd values = legendre_polynomials(order, x);
      slope = order * (values[order - 1] - x * values[order]) / ((1 - x) * (1 + x));
      x -= values[order] / slope;
    }
    rule.nodes[i] = x;
    rule.weights[i] = 2 / ((1 - x) * (1 + x) * slope * slope);
  }
  return rule;
}

/// Integrals of P_0...P_(order-1) from -1 to a point: (P_(n+1) - P_(n-1)) / (2n+1).
VectorXd legendre_integrals(int order, double point) {
  const VectorXd values = legendre_polynomials(order, point);
  VectorXd integrals(order);
  integrals[0] = std::clamp(point, -1.0, 1.0) + 1;
  for (Index n = 1; n < order; ++n)
    integrals[n] = (values[n + 1] - values[n - 1]) / static_cast<double>(2 * n + 1);
  return integrals;
}

/// j_0...j_(size-1) at z >= 0. Upward recurrence is stable for n < z, and GSL's continued fraction slow
/// there.
void spherical_bessel(double z, VectorXd& values) {
  const auto size = static_cast<int>(values.size());
  if (z < size) {
    gsl_sf_bessel_jl_steed_array(size - 1, z, values.data());
    return;
  }
  values[0] = portable::sin(z) / z;
  if (size > 1) values[1] = (values[0] - portable::cos(z)) / z;
  for (Index n = 1; n + 1 < size; ++n)
    values[n + 1] = static_cast<double>(2 * n + 1) / z * values[n] - values[n - 1];
}

}  // namespace

Panels::Panels(std::vector<double> breaks, int order)
    : breaks_(std::move(breaks)),
      order_(order),
      nodes_(static_cast<Index>(count()) * order),
      weights_(nodes_.size()),
      legendre_(order, order) {
  const GaussRule rule = gauss_rule(order);
  for (std::size_t panel = 0; panel < count(); ++panel) {
    nodes_.segment(first(panel), order) = middle(panel) + half_width(panel) * rule.nodes.array();
    weights_.segment(first(panel), order) = half_width(panel) * rule.weights;
  }
  for (Index i = 0; i < order; ++i)
    for (Index n = 0; n < order; ++n)
      legendre_(n, i) = (static_cast<double>(n) + 0.5) * rule.weights[i] *
                        legendre_polynomials(order - 1, rule.nodes[i])[n];
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
      spherical_bessel(k[row] * half_width(panel), bessel);
      for (Index n = 0; n < order_; ++n)
        (n % 2 == 0 ? even_terms : odd_terms)(n, row) = (n % 4 < 2 ? 2 : -2) * bessel[n];
    }
    const Eigen::ArrayXd phase = k.array() * middle(panel);
    const Eigen::ArrayXd cosine = half_width(panel) * phase.unaryExpr(&portable::cos),
                         sine = half_width(panel) * phase.unaryExpr(&portable::sin);
    const Eigen::ArrayXXd real = (even_terms.transpose() * legendre_).array();
    const Eigen::ArrayXXd imaginary = (odd_terms.transpose() * legendre_).array();
    result.cosine.middleCols(first(panel), order_) = real.colwise() * cosine - imaginary.colwise() * sine;
    result.sine.middleCols(first(panel), order_) = real.colwise() * sine + imaginary.colwise() * cosine;
  }
  result.cosine_minus_one = result.cosine.rowwise() - weights_.transpose();
  // Where exp(i k p) hardly varies on a panel, the Gauss rule is exact and does not cancel.
  for (std::size_t panel = 0; panel < count(); ++panel)
    for (Index row = 0; row < rows; ++row) {
      if (k[row] * half_width(panel) > 0.5) continue;
      const Eigen::ArrayXd phase = k[row] * nodes_.segment(first(panel), order_).array();
      const Eigen::ArrayXd weights = weights_.segment(first(panel), order_).array();
      result.cosine.row(row).segment(first(panel), order_) = weights * phase.unaryExpr(&portable::cos);
      result.cosine_minus_one.row(row).segment(first(panel), order_) =
          -2 * weights * (0.5 * phase).unaryExpr(&portable::sin).square();
      result.sine.row(row).segment(first(panel), order_) = weights * phase.unaryExpr(&portable::sin);
    }
  return result;
}

std::vector<double> graded_breaks(double smallest, double largest, double ratio) {
  std::vector<double> breaks{0};
  const int steps =
      std::max(1, static_cast<int>(std::ceil(portable::log(largest / smallest) / portable::log(ratio))));
  for (int step = steps; step >= 0; --step) breaks.push_back(largest * portable::pow(ratio, -step));
  return breaks;
}

}  // namespace lorentz
