#include "boltzmann/gmres.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "numerics/random.hpp"

namespace gmres_test {

using namespace lorentz;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

LinearMap product(const MatrixXd& matrix) {
  return [matrix](const VectorXd& v) -> VectorXd { return matrix * v; };
}

MatrixXd random_matrix(Index rows, Index columns, std::uint64_t seed) {
  RandomStream random({seed, 0}, Purpose::initial_position, 0);
  return MatrixXd::NullaryExpr(rows, columns, [&] { return random.gaussian(); });
}

/// A nonsymmetric matrix with eigenvalues around 3.
MatrixXd well_conditioned(Index size, std::uint64_t seed) {
  return 3 * MatrixXd::Identity(size, size) +
         random_matrix(size, size, seed) / std::sqrt(static_cast<double>(size));
}

double residual(const MatrixXd& a, const VectorXd& x, const VectorXd& b) {
  return (b - a * x).norm() / b.norm();
}

// The residual is least over the Krylov space if it is orthogonal to the image of that space. Detected
// mistakes: the limit of the steps is off by one; Givens rotations have the wrong sign.
TEST(Gmres, MinimisesTheResidualWithinTheLimit) {
  const MatrixXd a = well_conditioned(20, 6);
  const VectorXd b = random_matrix(20, 1, 7);
  const KrylovResult found = gmres(product(a), b, 1e-12, 4);
  EXPECT_EQ(found.iterations, 4);
  VectorXd image = a * b;  // of the unknown's Krylov space b, A b, ...
  for (int power = 0; power < 4; ++power, image = a * image)
    EXPECT_LT(std::abs(image.dot(b - a * found.solution)), 1e-12 * image.norm() * b.norm()) << power;
  EXPECT_GT(std::abs(image.dot(b - a * found.solution)), 1e-6 * image.norm() * b.norm());
}

TEST(Gmres, StopsAtTheTolerance) {
  const MatrixXd a = well_conditioned(40, 8);
  const VectorXd ones = VectorXd::Ones(40);
  int before = 0;
  for (const double tolerance : {1e-1, 1e-3, 1e-6, 1e-9}) {
    const KrylovResult found = gmres(product(a), ones, tolerance, 50);
    EXPECT_LE(residual(a, found.solution, ones), 1.0001 * tolerance);
    EXPECT_GT(found.iterations, before);
    before = found.iterations;
  }
  EXPECT_EQ(gmres(product(a), 0 * ones, 1e-12, 50).iterations, 0);
}

}  // namespace gmres_test
