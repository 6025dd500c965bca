#include "numerics/gmres.hpp"

#include <gsl/gsl_linalg.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "numerics/random.hpp"

namespace gmres_test {

using namespace lorentz;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

LinearMap product(const MatrixXd& matrix) {
  return [matrix](const VectorXd& v) -> VectorXd { return matrix * v; };
}

const LinearMap identity = [](const VectorXd& v) { return v; };

MatrixXd random_matrix(Index rows, Index columns, std::uint64_t seed) {
  RandomStream random({seed, 0}, Purpose::initial_position, 0);
  return MatrixXd::NullaryExpr(rows, columns, [&] { return random.gaussian(); });
}

/// A nonsymmetric matrix with eigenvalues around 3.
MatrixXd well_conditioned(Index size, std::uint64_t seed) {
  return 3 * MatrixXd::Identity(size, size) +
         random_matrix(size, size, seed) / std::sqrt(static_cast<double>(size));
}

VectorXd ones(Index size) { return VectorXd::Ones(size); }

/// Solution of a x = b by the LU decomposition of GSL, which needs no compilation here.
VectorXd solve(const MatrixXd& a, VectorXd b) {
  MatrixXd lu = a.transpose();  // GSL stores rows
  const auto size = static_cast<std::size_t>(b.size());
  gsl_matrix_view matrix = gsl_matrix_view_array(lu.data(), size, size);
  gsl_vector_view x = gsl_vector_view_array(b.data(), size);
  gsl_permutation* const order = gsl_permutation_alloc(size);
  int sign = 0;
  gsl_linalg_LU_decomp(&matrix.matrix, order, &sign);
  gsl_linalg_LU_svx(&matrix.matrix, order, &x.vector);
  gsl_permutation_free(order);
  return b;
}

double residual(const MatrixXd& a, const VectorXd& x, const VectorXd& b) {
  return (b - a * x).norm() / b.norm();
}

/// Cyclic shift of the unit vectors: the residual does not decrease before the last step.
MatrixXd cyclic_shift(Index size) {
  MatrixXd matrix = MatrixXd::Zero(size, size);
  for (Index i = 0; i < size; ++i) matrix((i + 1) % size, i) = 1;
  return matrix;
}

// Detected mistake: vectors are not orthogonalised against the last basis vector.
TEST(Gmres, SolvesASystemInAsManyStepsAsItHasDimensions) {
  for (const Index size : {1, 2, 5, 12}) {
    const MatrixXd a = well_conditioned(size, 1);
    const VectorXd b = random_matrix(size, 1, 2), exact = solve(a, b);
    const KrylovResult found = gmres(product(a), identity, b, 1e-13, 50);
    EXPECT_LT((found.solution - exact).norm(), 1e-12 * exact.norm()) << size;
    EXPECT_LE(found.iterations, size);
  }
}

TEST(Gmres, TakesOneStepForEveryEigenvalue) {
  const VectorXd eigenvalues = (VectorXd(9) << 2, 2, 2, 5, 5, 5, 5, -1, -1).finished();
  const MatrixXd a = eigenvalues.asDiagonal();
  const KrylovResult found = gmres(product(a), identity, ones(9), 1e-12, 50);
  EXPECT_EQ(found.iterations, 3);
  EXPECT_LT(residual(a, found.solution, ones(9)), 1e-12);
}

// Detected mistake: y is returned instead of x = P y.
TEST(Gmres, ThePreconditionerChangesTheStepsOnly) {
  const MatrixXd a = well_conditioned(12, 3);
  const VectorXd b = random_matrix(12, 1, 4);
  const VectorXd exact = solve(a, b);
  const KrylovResult plain = gmres(product(a), identity, b, 1e-12, 50);
  const KrylovResult solved = gmres(product(a), [&](const VectorXd& v) { return solve(a, v); }, b, 1e-12, 50);
  EXPECT_GT(plain.iterations, 8);
  EXPECT_EQ(solved.iterations, 1);
  EXPECT_LT((solved.solution - exact).norm(), 1e-11 * exact.norm());
  const KrylovResult other = gmres(product(a), product(well_conditioned(12, 5)), b, 1e-12, 50);
  EXPECT_LT((other.solution - exact).norm(), 1e-11 * exact.norm());
}

// The result minimises the residual over the Krylov space. Detected mistakes: the limit of the steps is off
// by one; Givens rotations have the wrong sign.
TEST(Gmres, MinimisesTheResidualWithinTheLimit) {
  const MatrixXd a = well_conditioned(20, 6);
  const VectorXd b = random_matrix(20, 1, 7);
  MatrixXd krylov(20, 4);
  krylov.col(0) = b;
  for (Index k = 1; k < 4; ++k) krylov.col(k) = a * krylov.col(k - 1);
  const MatrixXd image = a * krylov;
  const VectorXd best = krylov * solve(image.transpose() * image, image.transpose() * b);
  const KrylovResult found = gmres(product(a), identity, b, 1e-12, 4);
  EXPECT_EQ(found.iterations, 4);
  EXPECT_LT((found.solution - best).norm(), 1e-10 * best.norm());
}

TEST(Gmres, StopsAtTheLimitOrTheTolerance) {
  const MatrixXd shift = cyclic_shift(6);
  const VectorXd b = VectorXd::Unit(6, 0);
  EXPECT_LT(residual(shift, gmres(product(shift), identity, b, 1e-12, 6).solution, b), 1e-12);
  const KrylovResult short_of_it = gmres(product(shift), identity, b, 1e-12, 5);
  EXPECT_EQ(short_of_it.iterations, 5);
  EXPECT_NEAR(residual(shift, short_of_it.solution, b), 1, 1e-12);

  const MatrixXd a = well_conditioned(40, 8);
  int before = 0;
  for (const double tolerance : {1e-1, 1e-3, 1e-6, 1e-9}) {
    const KrylovResult found = gmres(product(a), identity, ones(40), tolerance, 50);
    EXPECT_LE(residual(a, found.solution, ones(40)), 1.0001 * tolerance);
    EXPECT_GT(found.iterations, before);
    before = found.iterations;
  }
}

TEST(Gmres, NothingIsTheSolutionForNothing) {
  const KrylovResult found = gmres(product(well_conditioned(3, 9)), identity, VectorXd::Zero(3), 1e-12, 50);
  EXPECT_EQ(found.iterations, 0);
  EXPECT_EQ(found.solution, VectorXd::Zero(3).eval());
}

// A singular system that has a solution is solved. If there is no solution, the residual is not reported as
// small.
TEST(Gmres, SolvesASingularSystemThatHasASolution) {
  const VectorXd v = random_matrix(6, 1, 10).normalized();
  const MatrixXd q = MatrixXd::Identity(6, 6) - 2 * v * v.transpose();  // a reflection
  const VectorXd eigenvalues = (VectorXd(6) << 0, 1, 2, 3, 4, 5).finished();
  const MatrixXd a = q * eigenvalues.asDiagonal() * q.transpose();
  const VectorXd possible = a * random_matrix(6, 1, 11), impossible = possible + q.col(0);
  const KrylovResult found = gmres(product(a), identity, possible, 1e-12, 5);
  EXPECT_LT(residual(a, found.solution, possible), 1e-11);
  const double left = residual(a, gmres(product(a), identity, impossible, 1e-12, 5).solution, impossible);
  EXPECT_NEAR(left, 1 / impossible.norm(), 1e-9);
}

}  // namespace gmres_test
