#include "statistics/control_variates.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "statistics/standardised.hpp"

namespace lorentz {

namespace {

/// Number of standardised columns that vary.
std::size_t varying(const Matrix& controls) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < controls.columns(); ++k) count += varies(controls, k) ? 1 : 0;
  return count;
}

double dot(std::span<const double> a, std::span<const double> b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.);
}

/// Standard deviation of a column.
double deviation(const Records& records, std::size_t column) {
  return norm(centred(matrix_of(records, {column})), 0) / std::sqrt(static_cast<double>(records.size()) - 1);
}

/// The least number of records for a regression on so many columns.
std::size_t records_needed(std::size_t columns) {
  return columns > 0 ? std::max(3 * columns, columns + 8) : 0;
}

}  // namespace

std::optional<Records> regress_out(const Records& records, const Regression& regression) {
  const Matrix x = standardised(records, regression.controls), x_centred = centred(x);
  const std::size_t needed = records_needed(varying(x)), rows = x.rows();
  if (needed == 0 || rows < needed) return {};

  // Leave-one-out coefficients b_(i) = b - g_i residual_i / (1 - leverage_i) [eq. 33].
  const Matrix g = transposed(pseudo_inverse(x_centred));
  std::vector<double> left_out(rows);  // g_i.x_i / (1 - leverage_i)
  for (std::size_t i = 0; i < rows; ++i) {
    const double leverage = dot(g.row(i), x_centred.row(i)) + 1. / static_cast<double>(rows);
    if (leverage > 0.99) return {};  // close to 1 the leave-one-out coefficient is undetermined
    left_out[i] = dot(g.row(i), x.row(i)) / (1 - leverage);
  }

  Records reduced(regression.measured.size());
  for (std::size_t i = 0; i < rows; ++i) reduced.append(std::vector<double>(reduced.width()));
  for (std::size_t k = 0; k < reduced.width(); ++k) {
    const Matrix y = matrix_of(records, {regression.measured[k]}), y_centred = centred(y);
    std::vector<double> b(x.columns());
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t column = 0; column < b.size(); ++column) b[column] += g(i, column) * y_centred(i, 0);
    for (std::size_t i = 0; i < rows; ++i)
      reduced[i][k] = y(i, 0) - dot(b, x.row(i)) + left_out[i] * (y_centred(i, 0) - dot(b, x_centred.row(i)));
  }
  return reduced;
}

double variance_ratio(const Records& a, const Records& b, const Columns& columns) {
  double sum = 0, varying = 0;
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
  // Residual part of the standard deviation of a column that the controls determine.
  constexpr double determined = 1e-6;
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
      if (deviation(*corrected, k) < determined * deviation(records, column)) continue;
      measured.push_back(column);
      for (std::size_t i = 0; i < records.size(); ++i) reduced[i][column] = (*corrected)[i][k];
    }
  }
  const bool used = !measured.empty() && variance_ratio(reduced, records, measured) < 1;
  if (!used) reduced = records;
  return {std::move(reduced), ControlVariates{used ? fitted : 0, needed}};
}

}  // namespace lorentz
