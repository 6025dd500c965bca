#include "statistics/control_variates.hpp"

#include <Eigen/Dense>
#include <span>

namespace lorentz {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Every column divided by its standard deviation over the rows. One that does not vary, or that varies in
/// one row as much as in all others together, becomes 0: without that row it would have no coefficient.
Matrix standardised(const Matrix& columns) {
  const Matrix centred = columns.rowwise() - columns.colwise().mean();
  const Eigen::RowVectorXd squares = centred.colwise().squaredNorm();
  const Eigen::RowVectorXd largest = centred.cwiseAbs2().colwise().maxCoeff();
  const Eigen::RowVectorXd weight =
      (2 * largest.array() < squares.array()).select(squares.cwiseSqrt().cwiseInverse(), 0);
  return columns * weight.asDiagonal();
}

}  // namespace

Records reduce_variance(const Records& records, std::size_t controls) {
  if (records.size() < 3 * controls || controls == 0) return records;
  const auto rows = static_cast<Eigen::Index>(records.size());
  const auto c = static_cast<Eigen::Index>(controls);
  const Eigen::Map<const Matrix> all(records.values().data(), rows,
                                     static_cast<Eigen::Index>(records.width()));
  const Matrix x = standardised(all.rightCols(c));
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

  // b without record i is b - gain_i residual_i / (1 - leverage_i).
  const Eigen::VectorXd own = gain.cwiseProduct(x).rowwise().sum().array() / (1 - leverage.array());
  Matrix reduced = all;
  reduced.leftCols(y.cols()) = y - x * coefficients + own.asDiagonal() * residual;

  Records result(records.width());
  for (Eigen::Index i = 0; i < rows; ++i) result.append(std::span(reduced.row(i).data(), records.width()));
  return result;
}

}  // namespace lorentz
