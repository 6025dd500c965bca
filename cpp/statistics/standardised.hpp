#pragma once

#include <Eigen/Dense>

namespace lorentz {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Every column divided by the norm of its deviations from its mean, whatever its size; one that does not
/// vary by more than its rounding becomes 0.
Matrix standardised(const Matrix& columns);

}  // namespace lorentz
