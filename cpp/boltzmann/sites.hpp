#pragma once

#include <Eigen/Core>
#include <optional>

#include "boltzmann/panels.hpp"

namespace lorentz {

/// Matrices of free streaming. F(p > 0) starts at x = 0, F(p < 0) at x = 1, and each changes by the net gain
/// S_j = gamma (G_j - F_j) per unit of length at the sites that it passes [eq. 36, eq. 41]:
///
///   F(x, p > 0) = F(0, p) + sum_j S_j from_left(x, j),   F(x, p < 0) = F(1, p) + sum_j S_j from_right(x, j).
///
/// from_left + from_right does not depend on x away from the scatterers of a chain, so the current of every
/// quantity that G - F conserves is exactly constant in x [eq. 40].
struct Transport {
  Eigen::MatrixXd from_left, from_right;  // one row for each x, one column for each site
};

/// Positions in [0, 1] at which scattering is computed.
class Sites {
 public:
  /// Continuous scatterers: collocation at Gauss-Legendre nodes, implicit and stable for every gamma.
  static Sites continuum(int nodes);

  /// N scatterers at (j - 1/2)/N, j = 1, ..., N; the flux that arrives at a scatterer excludes its own gain
  /// [eq. 41].
  static Sites chain(int cells);

  const Eigen::VectorXd& positions() const { return positions_; }
  /// Streaming from the sites to the positions x.
  Transport transport_to(const Eigen::VectorXd& x) const;

 private:
  std::optional<Panels> interval_;  // none for a chain
  Eigen::VectorXd positions_;
};

}  // namespace lorentz
