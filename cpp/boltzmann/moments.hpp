#pragma once

#include <array>

#include "boltzmann/collision_operator.hpp"
#include "model/portable.hpp"
#include "model/reservoir.hpp"

namespace lorentz {

/// Integrals of |p|^n F(p) dp over either half line, one for each column of the flux.
class HalfMoments {
 public:
  HalfMoments(const Panels& momenta, const Flux& flux) : momenta_(momenta), flux_(flux) {}

  Eigen::RowVectorXd right(int n) const { return weights(n) * flux_.topRows(momenta_.size()); }
  Eigen::RowVectorXd left(int n) const { return weights(n) * flux_.bottomRows(momenta_.size()); }

  /// Without the modulus: int p^n F dp over the whole line.
  Eigen::RowVectorXd whole(int n) const { return right(n) + (n % 2 == 0 ? 1 : -1) * left(n); }

  /// What crosses from left to right minus what crosses from right to left: int sign(p) |p|^n F dp.
  Eigen::RowVectorXd net(int n) const { return right(n) - left(n); }

 private:
  Eigen::RowVectorXd weights(int n) const {
    const auto power = [n](double p) { return portable::pow(p, n); };
    return momenta_.weights().cwiseProduct(momenta_.nodes().unaryExpr(power)).transpose();
  }

  const Panels& momenta_;
  const Flux& flux_;
};

/// What scattering conserves flows through every x alike.
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

/// What two baths inject of each together: the scale that errors of the currents are measured by.
inline std::array<double, 3> injected(const Reservoir& left, const Reservoir& right) {
  return {left.rate + right.rate, left.rate * left.mean_energy() + right.rate * right.mean_energy(),
          left.rate * left.mean_momentum() + right.rate * right.mean_momentum()};
}

}  // namespace lorentz
