#pragma once

#include <Eigen/Core>

namespace lorentz {

/// Where scattering happens and what streaming makes of it. F(p > 0) starts at x = 0, F(p < 0) at x = 1; each
/// gains what the scattering sites on its way add, S = gamma (G - F) per unit of x:
///
///   F(x, p > 0) = F(0) + sum_j S_j from_left(x, j),   F(x, p < 0) = F(1) + sum_j S_j from_right(x, j).
///
/// What G - F conserves has the same current at every x, exactly.
struct Transport {
  Eigen::MatrixXd from_left, from_right;  // from the sites (columns) to the sites

  /// Scatterers everywhere: collocation at Gauss-Legendre nodes, implicit, stable for every gamma.
  static Transport continuum(int sites);

  /// N scatterers, a particle meeting site i with what it is on the bond before: sites j < i, or j > i,
  /// count.
  static Transport chain(int cells);
};

}  // namespace lorentz
