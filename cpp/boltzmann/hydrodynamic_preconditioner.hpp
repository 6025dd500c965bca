#pragma once

#include <Eigen/LU>

#include "boltzmann/collision_operator.hpp"

namespace lorentz {

/// Matrix over the sites of both half lines, F(p > 0) first, that is the same for every |p|.
struct Streaming {
  Eigen::MatrixXd matrix;

  /// Free streaming with absorption: F = L G maps the gain at the sites to the flux that arrives there, L =
  /// (1 + gamma B)^-1 gamma B with B = from_left or from_right.
  static Streaming absorbing(double gamma, const Eigen::MatrixXd& from_left,
                             const Eigen::MatrixXd& from_right);

  Flux operator()(const Flux& gain) const;
};

/// Approximate inverse of 1 - L G', accurate for the slow modes of a gas near equilibrium: the preconditioner
/// of Newton's linear systems.
///
/// At a Maxwellian, G' is diagonal in Hermite functions with the eigenvalues (-sigma)^n + (1-sigma^2)^n /
/// (1-sigma^n) for n >= 1 and 1 for n = 0 [eq. 42]: 1 for number, momentum and energy, n = 0, 1, 2, and less
/// beyond. Eigenvalues close to 1 slow the Krylov iteration at large gamma. Here the first few modes have
/// their own eigenvalues, at the temperature of each site; all other even modes share one eigenvalue, and all
/// other odd modes another. The modes with their own eigenvalues are a correction of low rank, which the
/// Woodbury formula inverts.
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
  Eigen::MatrixXd tests_, shapes_;  // for p > 0; columns: [site, mode]
  Eigen::PartialPivLU<Eigen::MatrixXd> factors_;
};

}  // namespace lorentz
