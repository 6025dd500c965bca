#pragma once

#include <Eigen/Core>

#include "statistics/tally.hpp"

namespace lorentz {

/// Columns of records, one row for each record.
Eigen::MatrixXd matrix_of(const Records& records, const Columns& columns);

/// Columns minus their means.
Eigen::MatrixXd centred(const Eigen::MatrixXd& x);

/// Columns of records divided by the norm of their deviations from the mean, without overflow or underflow. A
/// column that varies by no more than its rounding error becomes 0.
Eigen::MatrixXd standardised(const Records& records, const Columns& columns);

/// Pseudo-inverse of a matrix of standardised columns. Columns that others determine to 1 part in 10^8 do not
/// count.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& x);

}  // namespace lorentz
