#pragma once

#include <cstdint>
#include <limits>

#include "model/reservoir.hpp"
#include "model/rules/elastic.hpp"

namespace lorentz {

/// Parameters of an open chain: a row of cells between two reservoirs, each cell with one fixed scatterer at
/// its centre. A particle that reaches an opening is removed.
///
/// Marks along the chain are numbered in half cells: the left opening is 0, bond j (between scatterers j - 1
/// and j, which are counted from 0) is 2j, scatterer i is 2i + 1, the right opening is 2 cells.
struct OpenChain {
  std::uint32_t cells = 30;
  double cell_length = 1. / 30;
  double sigma = 0.5;                                      // (M-m)/(M+m)
  double gamma = std::numeric_limits<double>::infinity();  // mean number of scatterings in N cells
  Reservoir left = default_left, right = default_right;
  RuleChoice rule{Elastic::properties.name};  // of collisions

  bool deterministic() const { return gamma >= cells; }  // a particle scatters at every scatterer
  std::int64_t right_opening() const { return 2 * std::int64_t{cells}; }
};

}  // namespace lorentz
