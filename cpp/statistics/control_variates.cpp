#include "statistics/control_variates.hpp"

#include <gsl/gsl_eigen.h>
#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>

namespace lorentz {
namespace {

/// Power of two that scales a number to about 1, so that squares neither overflow nor underflow.
double towards_one(double number) {
  return number > 0 ? std::ldexp(1.0, std::min(1000, -std::ilogb(number))) : 1;
}

double norm(const std::vector<double>& x) {
  return std::sqrt(std::inner_product(x.begin(), x.end(), x.begin(), 0.0));
}

std::vector<double> column_of(const Records& records, std::size_t column) {
  std::vector<double> values;
  for (std::size_t i = 0; i < records.size(); ++i) values.push_back(records[i][column]);
  return values;
}

}  // namespace

std::vector<double> centred(std::vector<double> x) {
  const double mean = std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
  for (double& each : x) each -= mean;
  return x;
}

std::vector<std::vector<double>> standardised(const Records& records, const Columns& columns) {
  std::vector<std::vector<double>> result;
  for (const std::size_t column : columns) {
    std::vector<double> x = column_of(records, column);
    double largest = 0;
    for (const double each : x) largest = std::max(largest, std::abs(each));
    for (double& each : x) each *= towards_one(largest);
    const double deviation = norm(centred(x)), rounding = 1e-12 * norm(x);
    for (double& each : x) each *= deviation > rounding ? 1 / deviation : 0;
    result.push_back(std::move(x));
  }
  return result;
}

PseudoInverse inverse_of_products(const std::vector<std::vector<double>>& x) {
  const std::size_t size = x.size();
  const auto matrix = [size] {
    return std::unique_ptr<gsl_matrix, void (*)(gsl_matrix*)>(gsl_matrix_calloc(size, size), gsl_matrix_free);
  };
  const std::unique_ptr<gsl_eigen_symmv_workspace, void (*)(gsl_eigen_symmv_workspace*)> workspace(
      gsl_eigen_symmv_alloc(size), gsl_eigen_symmv_free);
  const auto products = matrix(), vectors = matrix();
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t j = 0; j < size; ++j)
      gsl_matrix_set(products.get(), i, j, std::inner_product(x[i].begin(), x[i].end(), x[j].begin(), 0.0));
  std::vector<double> values(size);
  gsl_vector_view view = gsl_vector_view_array(values.data(), size);
  gsl_eigen_symmv(products.get(), &view.vector, vectors.get(), workspace.get());

  const double smallest =
      *std::ranges::max_element(values) * static_cast<double>(size) * std::numeric_limits<double>::epsilon();
  PseudoInverse inverse{std::vector(size, std::vector<double>(size, 0)), 0};
  for (std::size_t k = 0; k < size; ++k) {
    if (!(values[k] > smallest)) continue;
    ++inverse.rank;
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t j = 0; j < size; ++j)
        inverse.elements[i][j] +=
            gsl_matrix_get(vectors.get(), i, k) * gsl_matrix_get(vectors.get(), j, k) / values[k];
  }
  return inverse;
}

std::optional<Records> regress_out(const Records& records, const Regression& regression) {
  const std::size_t rows = records.size(), controls = regression.controls.size();
  if (rows == 0 || controls == 0) return {};
  const std::vector<std::vector<double>> x = standardised(records, regression.controls);
  std::vector<std::vector<double>> x_centred;
  for (const std::vector<double>& column : x) x_centred.push_back(centred(column));
  const auto varying = static_cast<std::size_t>(
      std::ranges::count_if(x, [](const std::vector<double>& column) { return norm(column) > 0; }));
  if (varying == 0 || rows < std::max(3 * varying, varying + 8)) return {};

  // Row i of the gain: g_i [eq. 34].
  const PseudoInverse inverse = inverse_of_products(x_centred);
  std::vector<std::vector<double>> gain(controls, std::vector<double>(rows, 0));
  for (std::size_t k = 0; k < controls; ++k)
    for (std::size_t l = 0; l < controls; ++l)
      for (std::size_t i = 0; i < rows; ++i) gain[k][i] += x_centred[l][i] * inverse.elements[l][k];

  // Leave-one-out coefficients b_(i) = b - gain_i residual_i / (1 - leverage_i) [eq. 34].
  std::vector<double> own(rows, 0);
  for (std::size_t i = 0; i < rows; ++i) {
    double leverage = 1. / static_cast<double>(rows);
    for (std::size_t k = 0; k < controls; ++k) {
      leverage += gain[k][i] * x_centred[k][i];
      own[i] += gain[k][i] * x[k][i];
    }
    if (leverage > 0.99)
      return {};  // with a leverage close to 1, the leave-one-out coefficient is undetermined
    own[i] /= 1 - leverage;
  }
  Records reduced = records;
  for (const std::size_t column : regression.measured) {
    const std::vector<double> y = column_of(records, column), y_centred = centred(y);
    std::vector<double> corrected = y, residual = y_centred;
    for (std::size_t k = 0; k < controls; ++k) {
      const double coefficient = std::inner_product(gain[k].begin(), gain[k].end(), y_centred.begin(), 0.0);
      for (std::size_t i = 0; i < rows; ++i) {
        corrected[i] -= x[k][i] * coefficient;
        residual[i] -= x_centred[k][i] * coefficient;
      }
    }
    for (std::size_t i = 0; i < rows; ++i) reduced[i][column] = corrected[i] + own[i] * residual[i];
  }
  return reduced;
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

Group::Prepared reduce_variance(const Records& records, const std::vector<Regression>& regressions) {
  // Residual part of the variance of a column that the controls determine.
  constexpr double determined = 1e-12;
  Records reduced = records;
  Columns measured;
  for (const Regression& regression : regressions) {
    const std::optional<Records> corrected = regress_out(records, regression);
    if (!corrected) continue;
    for (const std::size_t column : regression.measured) {
      if (variance_ratio(*corrected, records, {column}) < determined) continue;
      for (std::size_t i = 0; i < records.size(); ++i) reduced[i][column] = (*corrected)[i][column];
      measured.push_back(column);
    }
  }
  if (measured.empty() || variance_ratio(reduced, records, measured) >= 1) return {records, false};
  return {std::move(reduced), true};
}

}  // namespace lorentz
