#pragma once

#include <Eigen/Core>

namespace lorentz {

/// Nodes, in ascending order, and weights of a quadrature rule on [-1, 1].
struct GaussRule {
  Eigen::VectorXd nodes, weights;
};

/// Gauss-Legendre rule of any order >= 1, exact for polynomials of degree 2 order - 1. Newton's method finds
/// the roots of P_order, starting from Tricomi's asymptotic approximation.
GaussRule gauss_legendre(int order);

/// Values of the Legendre polynomials P_0, ..., P_degree at a point, which is clamped to [-1, 1].
Eigen::VectorXd legendre_polynomials(int degree, double point);

}  // namespace lorentz
