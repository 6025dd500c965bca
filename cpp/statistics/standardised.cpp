#include "statistics/standardised.hpp"

#include <Eigen/QR>

#include "numerics/summation.hpp"

namespace lorentz {

using Eigen::Index;
using Eigen::MatrixXd;

MatrixXd matrix_of(const Records& records, const Columns& columns) {
  MatrixXd result(records.size(), columns.size());
  for (std::size_t i = 0; i < records.size(); ++i)
    for (std::size_t k = 0; k < columns.size(); ++k)
      result(static_cast<Index>(i), static_cast<Index>(k)) = records[i][columns[k]];
  return result;
}

MatrixXd centred(const MatrixXd& x) { return x.rowwise() - x.colwise().mean(); }

MatrixXd standardised(const Records& records, const Columns& columns) {
  MatrixXd x = matrix_of(records, columns);
  for (auto column : x.colwise()) {
    column *= towards_one(column.cwiseAbs().maxCoeff());
    const double deviation = centred(column).norm(), rounding = 1e-12 * column.norm();
    column *= deviation > rounding ? 1 / deviation : 0;
  }
  return x;
}

MatrixXd pseudo_inverse(const MatrixXd& x) {
  // Of the transpose, because Eigen solves for an identity matrix with as many rows as the matrix.
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> factors;
  factors.setThreshold(1e-8);
  factors.compute(x.transpose());
  return factors.pseudoInverse().transpose();
}

}  // namespace lorentz
