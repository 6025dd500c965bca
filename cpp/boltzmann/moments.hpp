#pragma once

#include <array>
#include <cmath>

#include "boltzmann/collision_operator.hpp"
#include "model/reservoir.hpp"

namespace lorentz {

/// Integrals of |p|^n F(p) dp over either half line, one element per column of the flux.
class HalfMoments {
 public:
  HalfMoments(const Panels& momenta, const Flux& flux) : momenta_(momenta), flux_(flux) {}

  Eigen::RowVectorXd right(int n) const { return weights(n) * flux_.topRows(momenta_.size()); }
  Eigen::RowVectorXd left(int n) const { return weights(n) * flux_.bottomRows(momenta_.size()); }

  /// Moments over the whole line, int p^n F dp.
  Eigen::RowVectorXd whole(int n) const { return right(n) + (n % 2 == 0 ? 1 : -1) * left(n); }

  /// Net transport to the right, int sign(p) |p|^n F dp.
  Eigen::RowVectorXd net(int n) const { return right(n) - left(n); }

 private:
  Eigen::RowVectorXd weights(int n) const {
    const auto power = [n](double p) { return std::pow(p, n); };
    return momenta_.weights().cwiseProduct(momenta_.nodes().unaryExpr(power)).transpose();
  }

  const Panels& momenta_;
  const Flux& flux_;
};

/// Currents of the conserved quantities [eq. 26], one element per column of the flux; constant in x for a
/// stationary solution [eq. 40].
struct Currents {
  Eigen::RowVectorXd particles;  // int sign(p) F dp
  Eigen::RowVectorXd energy;     // int sign(p) p^2/2 F dp
  Eigen::RowVectorXd momentum;   // int |p| F dp

  explicit Currents(const HalfMoments& moments)
      : particles(moments.net(0)),
        energy(0.5 * moments.net(2)),
        momentum(moments.right(1) + moments.left(1)) {}

  std::array<double, 3> values(Eigen::Index column) const {
    return {particles[column], energy[column], momentum[column]};
  }
};

/// Particles, energy and momentum that two baths together inject per unit time, the scale of errors of the
/// currents.
inline std::array<double, 3> injected(const Reservoir& left, const Reservoir& right) {
  return {left.rate + right.rate, left.rate * left.mean_energy() + right.rate * right.mean_energy(),
          left.rate * left.mean_momentum() + right.rate * right.mean_momentum()};
}

}  // namespace lorentz
