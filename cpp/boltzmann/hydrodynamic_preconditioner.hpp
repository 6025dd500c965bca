#pragma once

#include <Eigen/LU>

#include "boltzmann/collision_operator.hpp"

namespace lorentz {

/// A matrix on the sites of both half lines, F(p > 0) first, that acts alike on every p.
struct Streaming {
  Eigen::MatrixXd matrix;

  /// With absorption: F = L S takes what is scattered in at the sites to what arrives there,
  /// L = (1 + gamma B)^-1 gamma B with B of either direction.
  static Streaming absorbing(double gamma, const Eigen::MatrixXd& from_left,
                             const Eigen::MatrixXd& from_right);

  Flux operator()(const Flux& gain) const;
};

/// Approximate inverse of 1 - L G', right for the slow modes of a gas near equilibrium.
///
/// At a Maxwellian, G' is diagonal in Hermite functions, with the eigenvalues
/// (-sigma)^n + (1-sigma^2)^n / (1-sigma^n): 1 for n = 0, 1, 2 (number, momentum and energy), below 1 beyond.
/// Those close to 1 are what makes iterations slow when gamma is large. Here the first few have their own
/// eigenvalues, at the temperature of each site; all other even ones share one, and all other odd ones.
class HydrodynamicPreconditioner {
 public:
  HydrodynamicPreconditioner(double sigma, const Panels& momenta, const Streaming& streaming,
                             const Eigen::RowVectorXd& temperatures);

  Flux operator()(const Flux& residual) const;

 private:
  Flux common(const Flux& flux) const;
  Eigen::VectorXd moments(const Flux& flux) const;
  Flux modes(const Eigen::VectorXd& amplitudes) const;

  double even_, odd_;               // the shared eigenvalues
  Streaming response_;              // (1 - L G')^-1 L with the shared eigenvalues only
  Eigen::MatrixXd tests_, shapes_;  // for p > 0, all modes of one site, then of the next
  Eigen::PartialPivLU<Eigen::MatrixXd> factors_;
};

}  // namespace lorentz
