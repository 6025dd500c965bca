#include "boltzmann/gmres.hpp"

#include <Eigen/Jacobi>
#include <vector>

namespace lorentz {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

KrylovResult gmres(const LinearMap& a, const VectorXd& b, double tolerance, int limit) {
  const double size = b.norm();
  if (size == 0) return {b, 0};
  std::vector<VectorXd> basis{b / size};
  std::vector<Eigen::JacobiRotation<double>> rotations;
  MatrixXd triangle = MatrixXd::Zero(limit + 1, limit);
  VectorXd rest =
      VectorXd::Zero(limit + 1);  // b after the Givens rotations; |rest[n]| is the norm of the residual
  rest[0] = size;
  Index n = 0;
  while (n < limit && std::abs(rest[n]) > tolerance * size) {
    VectorXd next = a(basis.back());
    for (Index i = 0; i <= n; ++i) {
      triangle(i, n) = basis[static_cast<std::size_t>(i)].dot(next);
      next -= triangle(i, n) * basis[static_cast<std::size_t>(i)];
    }
    triangle(n + 1, n) = next.norm();
    if (triangle(n + 1, n) > 0) next /= triangle(n + 1, n);
    basis.push_back(std::move(next));
    for (Index i = 0; i < n; ++i)
      triangle.col(n).applyOnTheLeft(i, i + 1, rotations[static_cast<std::size_t>(i)].adjoint());
    rotations.emplace_back();
    rotations.back().makeGivens(triangle(n, n), triangle(n + 1, n));
    triangle.col(n).applyOnTheLeft(n, n + 1, rotations.back().adjoint());
    rest.applyOnTheLeft(n, n + 1, rotations.back().adjoint());
    ++n;
  }
  const VectorXd weights = triangle.topLeftCorner(n, n).triangularView<Eigen::Upper>().solve(rest.head(n));
  VectorXd solution = VectorXd::Zero(b.size());
  for (Index i = 0; i < n; ++i) solution += weights[i] * basis[static_cast<std::size_t>(i)];
  return {std::move(solution), static_cast<int>(n)};
}

}  // namespace lorentz
