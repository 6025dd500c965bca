#pragma once

#include <vector>

#include "statistics/tally.hpp"

namespace lorentz {

/// Standard errors of a mean from blocks of time joined by 1, 2, 4, ..., with their uncertainties [eq. 50]
/// (Flyvbjerg & Petersen, J. Chem. Phys. 91, 461 (1989)). The error rises with the block length until the
/// blocks are longer than the correlation time. Where they are anticorrelated it falls, as that of a
/// current whose particles leave through the opening by which they entered.
struct Blocking {
  std::vector<double> error;
  std::vector<double> uncertainty;  // of each error, if the blocks of that length are independent

  /// Whether the last doubling of the block length raises the error by at most three of its uncertainties.
  bool converged() const;
};

/// Error of the mean of all blocks; rows are independent replicas, columns successive blocks, a power of two
/// of them. The error is NaN if only one block is left.
Blocking blocking(const Records& blocks);

}  // namespace lorentz
