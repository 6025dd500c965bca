#pragma once

#include <Eigen/Dense>

namespace lorentz {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Columns divided by the norm of their deviations from the mean, without overflow or underflow. A column
/// that varies by no more than its rounding error becomes 0.
Matrix standardised(const Matrix& columns);

}  // namespace lorentz
