#pragma once

#include <Eigen/Core>
#include <functional>

namespace lorentz {

using LinearMap = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

/// Approximate solution and the number of iterations, which is the dimension of the Krylov space.
struct KrylovResult {
  Eigen::VectorXd solution;
  int iterations = 0;
};

/// Solution of A x = b by GMRES without restart (Saad & Schultz, SIAM J. Sci. Stat. Comput. 7, 856 (1986)).
/// The iteration starts at x = 0 and ends when |b - A x| <= `tolerance` |b|, or after `limit` iterations
/// without an error.
KrylovResult gmres(const LinearMap& a, const Eigen::VectorXd& b, double tolerance, int limit);

}  // namespace lorentz
