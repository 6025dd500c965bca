#include "boltzmann/collision_operator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace collision_operator_test {

using namespace lorentz;
using Eigen::VectorXd;

constexpr double temperature = 2;

double hermite(unsigned n, double z) {
  double before = 0, value = 1;
  for (unsigned k = 0; k < n; ++k) before = std::exchange(value, z * value - k * before);
  return value;
}

/// He_n times the Maxwellian.
Flux mode(unsigned n, const VectorXd& p) {
  const auto function = [n](double momentum) {
    const double z = momentum / std::sqrt(temperature);
    return std::exp(-z * z / 2) * hermite(n, z) / std::sqrt(std::tgamma(n + 1.));
  };
  Flux flux(2 * p.size(), 1);
  flux << p.unaryExpr(function), (-p).unaryExpr(function);
  return flux;
}

// At a Maxwellian the linearised gain has the eigenvalues of eq. 42. Detected mistake: they are those of
// -sigma.
TEST(CollisionOperator, DerivativeHasHermiteFunctionsAsEigenfunctions) {
  for (const double sigma : {-0.7, 0.5}) {
    const Panels momenta(graded_breaks(0.05, 11 * std::sqrt(temperature), 2), 14);
    CollisionOperator collision(sigma, {1, temperature}, momenta, Panels(graded_breaks(0.7, 800, 1.4), 14));
    collision.gain(Flux::Zero(2 * momenta.size(), 1));
    for (const unsigned n : {0U, 1U, 2U, 3U, 4U, 5U, 8U}) {
      const auto eigenvalue = [n](double s) {
        return n == 0 ? 1. : std::pow(-s, n) + std::pow(1 - s * s, n) / (1 - std::pow(s, n));
      };
      const Flux before = mode(n, momenta.nodes()), image = collision.derivative(before);
      EXPECT_LT((image - eigenvalue(sigma) * before).norm(), 1e-9 * before.norm()) << sigma << " " << n;
      if (n == 3) {
        EXPECT_GT((image - eigenvalue(-sigma) * before).norm(), 0.1 * before.norm()) << sigma << " " << n;
      }
    }
  }
}

}  // namespace collision_operator_test
