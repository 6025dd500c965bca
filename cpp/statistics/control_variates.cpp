#include "statistics/control_variates.hpp"

#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <span>
#include <utility>

#include "statistics/standardised.hpp"

namespace lorentz {

std::optional<Records> regress_out(const Records& records, const Regression& regression) {
  if (records.size() == 0 || regression.controls.empty()) return {};
  const auto rows = static_cast<Eigen::Index>(records.size());
  const Eigen::Map<const Matrix> all(records.values().data(), rows,
                                     static_cast<Eigen::Index>(records.width()));
  const Matrix x = standardised(all(Eigen::all, regression.controls));
  const Eigen::Index varying = (x.colwise().squaredNorm().array() > 0).count();
  if (varying == 0 || rows < std::max<Eigen::Index>(3 * varying, varying + 8)) return {};
  const Matrix x_centred = x.rowwise() - x.colwise().mean();
  const Matrix y = all(Eigen::all, regression.measured);
  const Matrix y_centred = y.rowwise() - y.colwise().mean();

  const Matrix inverse =
      (x_centred.transpose() * x_centred).eval().completeOrthogonalDecomposition().pseudoInverse();
  const Matrix gain = x_centred * inverse;  // row i: g_i [eq. 34]
  const Matrix coefficients = gain.transpose() * y_centred;
  const Matrix residual = y_centred - x_centred * coefficients;
  const Eigen::VectorXd leverage =
      gain.cwiseProduct(x_centred).rowwise().sum().array() + 1. / static_cast<double>(rows);

  // With a leverage close to 1, the leave-one-out coefficient is undetermined.
  if (leverage.maxCoeff() > 0.99) return {};

  // Leave-one-out coefficients b_(i) = b - gain_i residual_i / (1 - leverage_i) [eq. 34].
  const Eigen::VectorXd own = gain.cwiseProduct(x).rowwise().sum().array() / (1 - leverage.array());
  Matrix reduced = all;
  reduced(Eigen::all, regression.measured) = y - x * coefficients + own.asDiagonal() * residual;

  Records result(records.width());
  for (Eigen::Index i = 0; i < rows; ++i) result.append(std::span(reduced.row(i).data(), records.width()));
  return result;
}

double variance_ratio(const Records& a, const Records& b, const Columns& columns) {
  double sum = 0, varying = 0;
  const auto deviation = [](const Records& records, std::size_t column) {
    return gsl_stats_sd(records.values().data() + column, records.width(), records.size());
  };
  for (const std::size_t column : columns) {
    const double plain = deviation(b, column);
    if (!(plain > 0)) continue;
    const double ratio = deviation(a, column) / plain;
    sum += ratio * ratio;
    varying += 1;
  }
  return varying > 0 ? sum / varying : 1;
}

ReducedRecords reduce_variance(const Records& records, const std::vector<Regression>& regressions) {
  constexpr double determined =
      1e-12;  // residual part of the variance of a column that the controls determine
  Records reduced = records;
  Columns measured;
  for (const Regression& regression : regressions) {
    const std::optional<Records> corrected = regress_out(records, regression);
    if (!corrected) continue;
    for (const std::size_t column : regression.measured) {
      if (variance_ratio(*corrected, records, {column}) < determined) continue;
      reduced.copy_column(*corrected, column);
      measured.push_back(column);
    }
  }
  if (measured.empty() || variance_ratio(reduced, records, measured) >= 1) return {records, false};
  return {std::move(reduced), true};
}

}  // namespace lorentz
