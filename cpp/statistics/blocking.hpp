#pragma once

#include <vector>

#include "statistics/records.hpp"

namespace lorentz {

/// Errors of a mean from blocks of time joined by 1, 2, 4, ... (Flyvbjerg & Petersen, J. Chem. Phys. 91, 461
/// (1989)): they rise with the length of the blocks until these are longer than the correlations.
struct Blocking {
  std::vector<double> error;
  std::vector<double> uncertainty;  // of each error, if the blocks of that length are independent

  /// Whether the last doubling changed the error by no more than three of its uncertainties: CONVERGED.
  bool converged() const;
};

/// Rows are independent replicas, columns successive blocks. An error is NaN where one block is left in all.
/// Throws std::invalid_argument unless the number of columns is a power of two.
Blocking blocking(const Records& blocks);

}  // namespace lorentz
