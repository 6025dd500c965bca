#include "statistics/control_variates.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <span>

namespace lorentz {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A power of two that brings a number close to 1, so that squares neither overflow nor vanish.
double towards_one(double number) {
  return number > 0 ? std::ldexp(1.0, std::min(1000, -std::ilogb(number))) : 1;
}

/// Every column divided by its standard deviation over the rows; one that does not vary by more than its
/// rounding becomes 0.
Matrix standardised(const Matrix& columns) {
  const Eigen::RowVectorXd largest = columns.cwiseAbs().colwise().maxCoeff();
  const Matrix scaled = columns * largest.unaryExpr(&towards_one).asDiagonal();
  const Eigen::RowVectorXd deviation = (scaled.rowwise() - scaled.colwise().mean()).colwise().norm();
  const Eigen::RowVectorXd rounding = 1e-12 * scaled.colwise().norm();
  const Eigen::RowVectorXd weight =
      (deviation.array() > rounding.array()).select(deviation.cwiseInverse(), 0);
  return scaled * weight.asDiagonal();
}

}  // namespace

Records reduce_variance(const Records& records, std::size_t controls) {
  if (records.size() == 0 || controls == 0) return records;
  const auto rows = static_cast<Eigen::Index>(records.size());
  const auto c = static_cast<Eigen::Index>(controls);
  const Eigen::Map<const Matrix> all(records.values().data(), rows,
                                     static_cast<Eigen::Index>(records.width()));
  const Matrix x = standardised(all.rightCols(c));
  const Eigen::Index varying = (x.colwise().squaredNorm().array() > 0).count();
  if (rows < std::max(3 * varying, varying + 8)) return records;
  const Matrix x_centred = x.rowwise() - x.colwise().mean();
  const Matrix y = all.leftCols(all.cols() - c);
  const Matrix y_centred = y.rowwise() - y.colwise().mean();

  const Matrix inverse =
      (x_centred.transpose() * x_centred).eval().completeOrthogonalDecomposition().pseudoInverse();
  const Matrix gain = x_centred * inverse;  // rows: weight of a record in the coefficients
  const Matrix coefficients = gain.transpose() * y_centred;
  const Matrix residual = y_centred - x_centred * coefficients;
  const Eigen::VectorXd leverage =
      gain.cwiseProduct(x_centred).rowwise().sum().array() + 1. / static_cast<double>(rows);

  // Some control varies in hardly more than one record; without it there would be no coefficient.
  if (leverage.maxCoeff() > 0.99) return records;

  // b without record i is b - gain_i residual_i / (1 - leverage_i).
  const Eigen::VectorXd own = gain.cwiseProduct(x).rowwise().sum().array() / (1 - leverage.array());
  Matrix reduced = all;
  reduced.leftCols(y.cols()) = y - x * coefficients + own.asDiagonal() * residual;

  Records result(records.width());
  for (Eigen::Index i = 0; i < rows; ++i) result.append(std::span(reduced.row(i).data(), records.width()));
  return result;
}

}  // namespace lorentz
