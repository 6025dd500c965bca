#include "statistics/control_variates.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "statistics/standardised.hpp"

namespace lorentz {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;

namespace {

/// Number of standardised columns that vary.
std::size_t varying(const MatrixXd& controls) {
  return static_cast<std::size_t>((controls.colwise().squaredNorm().array() > 0).count());
}

/// The least number of records for a regression on so many columns.
std::size_t records_needed(std::size_t columns) {
  return columns > 0 ? std::max(3 * columns, columns + 8) : 0;
}

}  // namespace

std::optional<Records> regress_out(const Records& records, const Regression& regression) {
  const MatrixXd x = standardised(records, regression.controls), x_centred = centred(x);
  const std::size_t needed = records_needed(varying(x));
  if (needed == 0 || records.size() < needed) return {};
  const Index rows = x.rows();

  // Column i of the gain: g_i [eq. 34].
  const MatrixXd gain = pseudo_inverse(x_centred);
  // Leave-one-out coefficients b_(i) = b - gain_i residual_i / (1 - leverage_i) [eq. 34].
  const ArrayXd leverage =
      gain.transpose().cwiseProduct(x_centred).rowwise().sum().array() + 1. / static_cast<double>(rows);
  if (leverage.maxCoeff() > 0.99)
    return {};  // with a leverage close to 1, the leave-one-out coefficient is undetermined
  const ArrayXd own = gain.transpose().cwiseProduct(x).rowwise().sum().array() / (1 - leverage);

  Records reduced(regression.measured.size());
  for (Index i = 0; i < rows; ++i) reduced.append(std::vector<double>(reduced.width()));
  for (std::size_t k = 0; k < reduced.width(); ++k) {
    const MatrixXd y = matrix_of(records, {regression.measured[k]}), y_centred = centred(y);
    const MatrixXd coefficients = gain * y_centred;
    const MatrixXd corrected =
        y - x * coefficients + (own * (y_centred - x_centred * coefficients).array()).matrix();
    for (Index i = 0; i < rows; ++i) reduced[static_cast<std::size_t>(i)][k] = corrected(i);
  }
  return reduced;
}

double variance_ratio(const Records& a, const Records& b, const Columns& columns) {
  double sum = 0, varying = 0;
  const auto deviation = [](const Records& records, std::size_t column) {
    return centred(matrix_of(records, {column})).stableNorm() /
           std::sqrt(static_cast<double>(records.size()) - 1);
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

Group::Prepared reduce_variance(const Records& records, const std::vector<Regression>& regressions) {
  // Residual part of the variance of a column that the controls determine.
  constexpr double determined = 1e-12;
  Records reduced = records;
  Columns measured;
  std::size_t needed = 0, fitted = 0;
  for (const Regression& regression : regressions) {
    const std::size_t columns = varying(standardised(records, regression.controls));
    needed = std::max(needed, records_needed(columns));
    const std::optional<Records> corrected = regress_out(records, regression);
    if (!corrected) continue;
    fitted = std::max(fitted, columns);
    for (std::size_t k = 0; k < corrected->width(); ++k) {
      const std::size_t column = regression.measured[k];
      for (std::size_t i = 0; i < records.size(); ++i) reduced[i][column] = (*corrected)[i][k];
      if (variance_ratio(reduced, records, {column}) >= determined)
        measured.push_back(column);
      else
        for (std::size_t i = 0; i < records.size(); ++i) reduced[i][column] = records[i][column];
    }
  }
  const bool used = !measured.empty() && variance_ratio(reduced, records, measured) < 1;
  if (!used) reduced = records;
  return {std::move(reduced), ControlVariates{used ? fitted : 0, needed}};
}

}  // namespace lorentz
