#pragma once

#include <stdexcept>

#include "boltzmann/collision_operator.hpp"
#include "boltzmann/sites.hpp"
#include "model/reservoir.hpp"

namespace lorentz {

/// Stationary Boltzmann equation [eq. 36] for the flux F(p, x) on [0, 1] between two baths (m = k_B = 1),
///
///   sign(p) dF/dx = gamma (G - F),   F(p > 0, x = 0) and F(p < 0, x = 1) given,
///
/// or, with `cells` > 0, the mean-field chain [eq. 41]: scatterers that each scatter a particle with
/// probability gamma/cells, with F and g independent at each.
struct KineticProblem {
  double sigma = 0.5;
  double gamma = 1;
  Reservoir left = default_left, right = default_right;
  int cells = 0;
};

/// Numerical resolution. One level up multiplies the number of nodes on every panel of p and k, and of nodes
/// in x, by about sqrt(2), so that the number of unknowns doubles. Errors fall exponentially with the number
/// of nodes. Level 0 is the coarsest in normal use.
struct Resolution {
  int order;  // nodes on every panel of p and k
  int sites;  // nodes in x; a chain has its scatterers instead

  static Resolution level(int level, double gamma);
};

/// Newton's iteration did not converge within its limits.
struct ConvergenceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Solution of a KineticProblem by Newton's method, with GMRES for the linear systems.
class KineticSolution {
 public:
  /// `guess`: a solution at another resolution, from which the iteration starts. Throws ConvergenceError.
  KineticSolution(const KineticProblem& problem, const Resolution& resolution,
                  const KineticSolution* guess = nullptr);

  /// F at positions x in [0, 1], one column each. At a scatterer of a chain, the flux of the arriving
  /// particles.
  Flux flux(const Eigen::VectorXd& x) const;

  /// g at positions x, one column each: density of U at points, then at minus the points.
  Flux scatterer_density(const Eigen::VectorXd& x, const Eigen::VectorXd& points) const;

  const Panels& momenta() const { return momenta_; }  // of the flux, on either half line
  int evaluations() const { return evaluations_; }    // of the collision operator or its derivative

 private:
  Flux deviation(const Eigen::VectorXd& x) const;
  Flux first_guess() const;
  Flux resampled(const KineticSolution& other) const;
  Flux arriving(const Transport& transport, const Flux& source) const;
  double size(const Flux& residual) const;
  void iterate(Flux flux);

  KineticProblem problem_;
  Reservoir equilibrium_;  // E; fluxes are stored as F - E
  Panels momenta_;
  Sites sites_;
  CollisionOperator collision_;
  Eigen::VectorXd left_, right_;  // injected fluxes minus E, at the nodes
  Flux source_;                   // gamma (G - F) at the sites
  int evaluations_ = 0;
};

}  // namespace lorentz
