#include "boltzmann/hydrodynamic_preconditioner.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "boltzmann/sites.hpp"

namespace hydrodynamic_preconditioner_test {

using namespace lorentz;
using Eigen::Index;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

/// 1 - L G' of a gas in equilibrium at T = 2, between walls of the same temperature.
class Equilibrium {
 public:
  Equilibrium(double sigma, double gamma)
      : sigma_(sigma),
        momenta_(graded_breaks(0.05, 11 * std::sqrt(temperature), 2), 14),
        collision_(sigma, {1, temperature}, momenta_, Panels(graded_breaks(0.7, 800, 1.4), 14)),
        sites_(Sites::continuum(8)) {
    const Transport transport = sites_.transport_to(sites_.positions());
    streaming_ = Streaming::absorbing(gamma, transport.from_left, transport.from_right);
    collision_.gain(Flux::Zero(2 * momenta_.size(), count()));
  }

  Index count() const { return sites_.positions().size(); }
  const Panels& momenta() const { return momenta_; }

  Flux collide(const Flux& flux) const { return collision_.derivative(flux); }
  Flux linearised(const Flux& flux) const { return flux - streaming_(collide(flux)); }

  HydrodynamicPreconditioner preconditioner(double sigma) const {
    return {sigma, momenta_, streaming_, RowVectorXd::Constant(count(), temperature)};
  }
  HydrodynamicPreconditioner preconditioner() const { return preconditioner(sigma_); }

  /// He_n times the Maxwellian, with a different amplitude at every site.
  Flux mode(unsigned n) const {
    const auto function = [&](double p) {
      const double z = p / std::sqrt(temperature);
      return std::exp(-z * z / 2) * hermite(n, z) / std::sqrt(std::tgamma(n + 1.));
    };
    const VectorXd& p = momenta_.nodes();
    VectorXd line(2 * p.size());
    line << p.unaryExpr(function), (-p).unaryExpr(function);
    return line * (2 + (5 * sites_.positions().array()).cos()).matrix().transpose();
  }

 private:
  static constexpr double temperature = 2;

  static double hermite(unsigned n, double z) {
    double before = 0, value = 1;
    for (unsigned k = 0; k < n; ++k) before = std::exchange(value, z * value - k * before);
    return value;
  }

  double sigma_;
  Panels momenta_;
  CollisionOperator collision_;
  Sites sites_;
  Streaming streaming_;
};

double distance(const Flux& a, const Flux& b) { return (a - b).norm() / b.norm(); }

// The eigenvalues are those of eq. 42. Detected mistake: the eigenvalues are those of -sigma.
TEST(LinearisedCollisions, HaveHermiteFunctionsAsEigenfunctions) {
  for (const double sigma : {-0.7, 0.5}) {
    const Equilibrium gas(sigma, 1);
    for (const unsigned n : {0U, 1U, 2U, 3U, 4U, 5U, 8U}) {
      const auto eigenvalue = [n](double s) {
        return n == 0 ? 1. : std::pow(-s, n) + std::pow(1 - s * s, n) / (1 - std::pow(s, n));
      };
      const Flux mode = gas.mode(n), image = gas.collide(mode);
      EXPECT_LT((image - eigenvalue(sigma) * mode).norm(), 1e-9 * mode.norm()) << sigma << " " << n;
      if (n == 3) {
        EXPECT_GT((image - eigenvalue(-sigma) * mode).norm(), 0.1 * mode.norm()) << sigma << " " << n;
      }
    }
  }
}

// Six modes have their own eigenvalues and two more have the shared one, so 1 - L G' is inverted exactly for
// these eight modes and approximately for all others. Detected mistake: the preconditioner is that of -sigma,
// whose odd modes have other eigenvalues.
TEST(HydrodynamicPreconditioner, InvertsTheLinearisedOperatorForTheSlowModes) {
  for (const double sigma : {-0.7, 0.5}) {
    for (const double gamma : {1., 50.}) {
      const Equilibrium gas(sigma, gamma);
      const HydrodynamicPreconditioner inverse = gas.preconditioner();
      for (unsigned n = 0; n < 10; ++n) {
        const Flux mode = gas.mode(n), image = gas.linearised(mode);
        const double error = distance(inverse(image), mode);
        if (n < 8)
          EXPECT_LT(error, 1e-7) << sigma << " " << gamma << " " << n;
        else
          EXPECT_GT(error, 1e-3) << sigma << " " << gamma << " " << n;
      }
      const Flux third = gas.mode(3);
      EXPECT_GT(distance(gas.preconditioner(-sigma)(gas.linearised(third)), third), 0.01);
    }
  }
}

}  // namespace hydrodynamic_preconditioner_test
