#pragma once

#include <cstdint>
#include <limits>

#include "model/reservoir.hpp"

namespace lorentz {

/// A row of cells between two reservoirs; each has one fixed scatterer at its centre. A particle that leaves
/// is gone.
///
/// Places along the chain are counted in half cells: the left opening is 0, bond j (between scatterers j - 1
/// and j) is 2j, scatterer i is 2i + 1, the right opening is 2 cells.
struct OpenChain {
  std::uint32_t cells = 30;
  double cell_length = 1. / 30;
  double sigma = 0.5;                                      // (M-m)/(M+m)
  double gamma = std::numeric_limits<double>::infinity();  // mean number of scatterings in N cells
  Reservoir left{220, 900. / 11};
  Reservoir right{180, 1100. / 9};

  bool deterministic() const { return gamma >= cells; }  // a particle scatters at every scatterer
  std::int64_t right_opening() const { return 2 * std::int64_t{cells}; }
};

}  // namespace lorentz
