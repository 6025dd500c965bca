#include "statistics/control_variates.hpp"

#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <span>
#include <utility>

#include "statistics/standardised.hpp"

namespace lorentz {

std::optional<Records> regress_out(const Records& records, std::size_t controls) {
  if (records.size() == 0 || controls == 0) return {};
  const auto rows = static_cast<Eigen::Index>(records.size());
  const auto c = static_cast<Eigen::Index>(controls);
  const Eigen::Map<const Matrix> all(records.values().data(), rows,
                                     static_cast<Eigen::Index>(records.width()));
  const Matrix x = standardised(all.rightCols(c));
  const Eigen::Index varying = (x.colwise().squaredNorm().array() > 0).count();
  if (varying == 0 || rows < std::max<Eigen::Index>(3 * varying, varying + 8)) return {};
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
  if (leverage.maxCoeff() > 0.99) return {};

  // b without record i is b - gain_i residual_i / (1 - leverage_i).
  const Eigen::VectorXd own = gain.cwiseProduct(x).rowwise().sum().array() / (1 - leverage.array());
  Matrix reduced = all;
  reduced.leftCols(y.cols()) = y - x * coefficients + own.asDiagonal() * residual;

  Records result(records.width());
  for (Eigen::Index i = 0; i < rows; ++i) result.append(std::span(reduced.row(i).data(), records.width()));
  return result;
}

double variance_ratio(const Records& a, const Records& b, std::size_t first, std::size_t columns) {
  double sum = 0, varying = 0;
  const auto deviation = [](const Records& records, std::size_t column) {
    return gsl_stats_sd(records.values().data() + column, records.width(), records.size());
  };
  for (std::size_t column = first; column < first + columns; ++column) {
    const double plain = deviation(b, column);
    if (!(plain > 0)) continue;
    const double ratio = deviation(a, column) / plain;
    sum += ratio * ratio;
    varying += 1;
  }
  return varying > 0 ? sum / varying : 1;
}

ReducedRecords reduce_variance(const Records& records, std::size_t controls) {
  std::optional<Records> reduced = regress_out(records, controls);
  if (!reduced || variance_ratio(*reduced, records, 0, records.width() - controls) >= 1)
    return {records, false};
  return {*std::move(reduced), true};
}

}  // namespace lorentz
