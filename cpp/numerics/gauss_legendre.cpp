#include "numerics/gauss_legendre.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lorentz {

Eigen::VectorXd legendre_polynomials(int degree, double point) {
  Eigen::VectorXd values = Eigen::VectorXd::Ones(degree + 1);
  const double x = std::clamp(point, -1.0, 1.0);
  if (degree > 0) values[1] = x;
  for (int n = 1; n < degree; ++n)
    values[n + 1] = ((2 * n + 1) * x * values[n] - n * values[n - 1]) / (n + 1);
  return values;
}

GaussRule gauss_legendre(int order) {
  GaussRule rule{Eigen::VectorXd(order), Eigen::VectorXd(order)};
  for (Eigen::Index i = 0; i < order; ++i) {
    double x = -std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (order + 0.5));
    double slope = 0;                       // derivative of P_order at x
    for (int step = 0; step < 5; ++step) {  // Newton's method, quadratic from an error below 0.01
      const Eigen::VectorXd values = legendre_polynomials(order, x);
      slope = order * (values[order - 1] - x * values[order]) / ((1 - x) * (1 + x));
      x -= values[order] / slope;
    }
    rule.nodes[i] = x;
    rule.weights[i] = 2 / ((1 - x) * (1 + x) * slope * slope);
  }
  return rule;
}

}  // namespace lorentz
