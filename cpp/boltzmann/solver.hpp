#pragma once

#include <functional>
#include <stdexcept>

#include "boltzmann/collision_operator.hpp"
#include "boltzmann/sites.hpp"
#include "model/reservoir.hpp"

namespace lorentz {

/// Stationary flux F(p, x) on [0, 1] between two baths (m = k_B = 1),
///
///   sign(p) dF/dx = gamma (G - F),   F(p > 0, x = 0) and F(p < 0, x = 1) given,
///
/// or, with `cells` > 0, of the mean-field chain: scatterers that each scatter a particle with probability
/// gamma/cells, F and g independent at each.
struct KineticProblem {
  double sigma = 0.5;
  double gamma = 1;
  Reservoir left{220, 900. / 11};
  Reservoir right{180, 1100. / 9};
  int cells = 0;
};

/// How finely a problem is resolved; level 0 is the coarsest of use. One level up, every panel of p and k and
/// the line have about sqrt(2) times as many nodes, so the number of unknowns doubles. Errors fall
/// exponentially.
struct Resolution {
  int order;  // nodes on every panel of p and k
  int sites;  // nodes in x; a chain has its scatterers instead

  static Resolution level(int level, double gamma);
};

/// No solution within the fixed limits of the iteration.
struct ConvergenceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Called at every evaluation of the collision operator; may throw, to stop.
using Heartbeat = std::function<void()>;

class KineticSolution {
 public:
  /// Newton's method with GMRES. Throws ConvergenceError. The guess, if any, is what another resolution
  /// found.
  KineticSolution(
      const KineticProblem& problem, const Resolution& resolution, const KineticSolution* guess = nullptr,
      const Heartbeat& heartbeat = [] {});

  /// F at any x in [0, 1], one column each. At a scatterer of a chain: of the particles that arrive there.
  Flux flux(const Eigen::VectorXd& x) const;

  /// g at any x: values of the density of U at points, then at minus the points.
  Flux scatterer_density(const Eigen::VectorXd& x, const Eigen::VectorXd& points) const;

  const Panels& momenta() const { return momenta_; }  // of the flux, on either half line
  int evaluations() const { return evaluations_; }    // of the collision operator or its derivative

 private:
  Flux deviation(const Eigen::VectorXd& x) const;
  Flux first_guess() const;
  Flux resampled(const KineticSolution& other) const;
  Flux arriving(const Transport& transport, const Flux& source) const;
  double size(const Flux& residual) const;
  void iterate(Flux deviation, const Heartbeat& heartbeat);

  KineticProblem problem_;
  Reservoir equilibrium_;  // what F is given as a deviation from
  Panels momenta_;
  Sites sites_;
  CollisionOperator collision_;
  Eigen::VectorXd left_, right_;  // what the baths inject, less the equilibrium, at the nodes
  Flux source_;                   // gamma (G - F) at the sites
  int evaluations_ = 0;
};

}  // namespace lorentz
