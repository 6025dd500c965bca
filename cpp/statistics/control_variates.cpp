#include "statistics/control_variates.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <span>

namespace lorentz {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A power of two for each column that brings its largest entry close to 1, so that squares neither overflow
/// nor vanish.
Eigen::RowVectorXd towards_one(const Matrix& columns) {
  return columns.cwiseAbs().colwise().maxCoeff().unaryExpr(
      [](double largest) { return largest > 0 ? std::ldexp(1.0, std::min(1000, -std::ilogb(largest))) : 1; });
}

Eigen::RowVectorXd deviation(const Matrix& columns) {
  return (columns.rowwise() - columns.colwise().mean()).colwise().norm();
}

/// Every column divided by its standard deviation over the rows; one that does not vary by more than its
/// rounding becomes 0.
Matrix standardised(const Matrix& columns) {
  const Matrix scaled = columns * towards_one(columns).asDiagonal();
  const Eigen::RowVectorXd spread = deviation(scaled), rounding = 1e-12 * scaled.colwise().norm();
  const Eigen::RowVectorXd weight = (spread.array() > rounding.array()).select(spread.cwiseInverse(), 0);
  return scaled * weight.asDiagonal();
}

}  // namespace

Records reduce_variance(const Records& records, std::size_t controls) {
  if (records.size() < 3 || controls == 0) return records;
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
  const Matrix corrected = y - x * coefficients + own.asDiagonal() * residual;
  const Eigen::RowVectorXd scale = towards_one(y);
  const Eigen::Array<bool, 1, Eigen::Dynamic> helps =
      deviation(corrected * scale.asDiagonal()).array() < deviation(y * scale.asDiagonal()).array();
  Matrix reduced = all;
  for (Eigen::Index column = 0; column < y.cols(); ++column)
    if (helps(column)) reduced.col(column) = corrected.col(column);

  Records result(records.width());
  for (Eigen::Index i = 0; i < rows; ++i) result.append(std::span(reduced.row(i).data(), records.width()));
  return result;
}

}  // namespace lorentz
