#pragma once

#include "numerics/matrix.hpp"
#include "statistics/tally.hpp"

namespace lorentz {

/// Columns of records, one row for each record.
Matrix matrix_of(const Records& records, const Columns& columns);

/// Columns minus their means.
Matrix centred(Matrix x);

/// Root of the sum of squares of a column, without overflow or underflow.
double norm(const Matrix& x, std::size_t column);

/// Columns of records divided by the norm of their deviations from the mean, without overflow or underflow. A
/// column that varies by no more than its rounding error becomes 0.
Matrix standardised(const Records& records, const Columns& columns);

/// Whether a standardised column varies.
bool varies(const Matrix& x, std::size_t column);

/// Pseudo-inverse of a matrix of standardised columns. Columns that others determine to 1 part in 10^8 do not
/// count.
Matrix pseudo_inverse(Matrix x);

}  // namespace lorentz
