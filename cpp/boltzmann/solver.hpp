#pragma once

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

struct Resolution {
  int order;  // nodes on every panel of p and of k
  int sites;  // nodes in x; ignored for a chain
};

/// The iteration did not converge within its fixed limits.
struct ConvergenceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class KineticSolution {
 public:
  KineticSolution(const KineticProblem& problem, const Resolution& resolution);

  /// Newton's method with GMRES, from the present flux. Throws ConvergenceError.
  void solve();

  /// Takes over what another resolution found, as a first guess.
  void start_from(const KineticSolution& other);

  /// F at any x in [0, 1], one column each.
  Flux flux(const Eigen::VectorXd& x) const;

  const Panels& momenta() const { return momenta_; }
  const CollisionOperator& collision() const { return collision_; }
  int evaluations() const { return evaluations_; }  // of the collision operator or its derivative

 private:
  Flux arriving(const Transport& transport, const Flux& source) const;
  Flux defect(const Flux& flux, Flux& gain);
  double size(const Flux& residual) const;

  KineticProblem problem_;
  Panels momenta_;
  Sites sites_;
  CollisionOperator collision_;
  Eigen::VectorXd left_, right_;  // what the baths inject, at the nodes
  Flux flux_, source_;            // F and gamma (G - F) at the sites
  int evaluations_ = 0;
};

}  // namespace lorentz
