#include "statistics/standardised.hpp"

#include <algorithm>
#include <cmath>

namespace lorentz {
namespace {

/// Power of two that scales a number to about 1, so that squares neither overflow nor underflow.
double towards_one(double number) {
  return number > 0 ? std::ldexp(1.0, std::min(1000, -std::ilogb(number))) : 1;
}

}  // namespace

Matrix standardised(const Matrix& columns) {
  const Eigen::RowVectorXd largest = columns.cwiseAbs().colwise().maxCoeff();
  const Matrix scaled = columns * largest.unaryExpr(&towards_one).asDiagonal();
  const Eigen::RowVectorXd deviation = (scaled.rowwise() - scaled.colwise().mean()).colwise().norm();
  const Eigen::RowVectorXd rounding = 1e-12 * scaled.colwise().norm();
  const Eigen::RowVectorXd weight =
      (deviation.array() > rounding.array()).select(deviation.cwiseInverse(), 0);
  return scaled * weight.asDiagonal();
}

}  // namespace lorentz
