#pragma once

#include <Eigen/Core>
#include <optional>

#include "boltzmann/panels.hpp"

namespace lorentz {

/// What streaming adds up: F(p > 0) starts at x = 0, F(p < 0) at x = 1, and each gains what the sites on its
/// way add to it, S_j = gamma (G_j - F_j) per unit of length:
///
///   F(x, p > 0) = F(0, p) + sum_j S_j from_left(x, j),   F(x, p < 0) = F(1, p) + sum_j S_j from_right(x, j).
///
/// from_left + from_right does not depend on x away from the scatterers of a chain, so whatever G - F
/// conserves has the same current at every x, exactly.
struct Transport {
  Eigen::MatrixXd from_left, from_right;  // one row for each x, one column for each site
};

/// The places in [0, 1] where scattering is computed.
class Sites {
 public:
  /// Scatterers everywhere: collocation at Gauss-Legendre nodes, implicit and stable for every gamma.
  static Sites continuum(int nodes);

  /// N scatterers at (j - 1/2)/N; each meets what arrives from either side, itself not included.
  static Sites chain(int cells);

  const Eigen::VectorXd& positions() const { return positions_; }
  Transport transport_to(const Eigen::VectorXd& x) const;

 private:
  std::optional<Panels> interval_;  // none for a chain
  Eigen::VectorXd positions_;
};

}  // namespace lorentz
