#pragma once

#include <cstdint>

#include "model/reservoir.hpp"
#include "model/scatterers.hpp"

namespace lorentz {

/// Parameters of an open chain: a row of cells between two reservoirs. A particle that reaches an opening is
/// removed.
///
/// Marks along the chain are numbered in half cells: the left opening is 0, bond j (between scatterers j - 1
/// and j, which are counted from 0) is 2j, scatterer i is 2i + 1, the right opening is 2 cells.
struct OpenChain : Scatterers {
  Reservoir left = default_left, right = default_right;

  std::int64_t right_opening() const { return 2 * std::int64_t{cells}; }
};

}  // namespace lorentz
