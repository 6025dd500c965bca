#pragma once

#include <Eigen/Core>
#include <functional>

namespace lorentz {

using LinearMap = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

struct KrylovResult {
  Eigen::VectorXd solution;
  int iterations = 0;
};

/// Solves A P y = b, x = P y by GMRES without restart (Saad & Schultz 1986), until the residual is below
/// `tolerance` times |b| or after `limit` iterations.
KrylovResult gmres(const LinearMap& a, const LinearMap& preconditioner, const Eigen::VectorXd& b,
                   double tolerance, int limit);

}  // namespace lorentz
