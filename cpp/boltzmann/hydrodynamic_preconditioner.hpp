#pragma once

#include <Eigen/LU>

#include "boltzmann/collision_operator.hpp"

namespace lorentz {

/// Streaming with absorption, column by column: F = L S takes what is scattered in at the sites to what
/// arrives there, L = (1 + gamma B)^-1 gamma B with B of either direction.
struct Streaming {
  Eigen::MatrixXd right, left;  // for p > 0 and p < 0

  Flux operator()(const Flux& gain) const;
};

/// Approximate inverse of 1 - L G', right for the slow modes of a gas near equilibrium.
///
/// At a Maxwellian, G' is diagonal in Hermite functions, with the eigenvalues
/// (-sigma)^n + (1-sigma^2)^n / (1-sigma^n): 1 for n = 0, 1, 2 (number, momentum and energy), below 1 beyond.
/// Those close to 1 are what makes iterations slow when gamma is large; G' is replaced by the first few
/// alone, at the temperature of each site.
class HydrodynamicPreconditioner {
 public:
  HydrodynamicPreconditioner(double sigma, const Panels& momenta, const Streaming& streaming,
                             const Eigen::RowVectorXd& temperatures);

  Flux operator()(const Flux& residual) const;

 private:
  Eigen::VectorXd moments(const Flux& flux) const;
  Flux modes(const Eigen::VectorXd& amplitudes) const;

  Streaming streaming_;
  Eigen::MatrixXd tests_, shapes_;  // for p > 0: He_n weights; He_n Maxwellian eigenvalue; site after site
  Eigen::PartialPivLU<Eigen::MatrixXd> factors_;
};

}  // namespace lorentz
