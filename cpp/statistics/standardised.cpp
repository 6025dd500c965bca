#include "statistics/standardised.hpp"

#include <gsl/gsl_linalg.h>

#include <cmath>
#include <utility>
#include <vector>

#include "numerics/summation.hpp"

namespace lorentz {

Matrix matrix_of(const Records& records, const Columns& columns) {
  Matrix result(records.size(), columns.size());
  for (std::size_t i = 0; i < records.size(); ++i)
    for (std::size_t k = 0; k < columns.size(); ++k) result(i, k) = records[i][columns[k]];
  return result;
}

Matrix centred(Matrix x) {
  for (std::size_t k = 0; k < x.columns(); ++k) {
    double sum = 0;
    for (std::size_t i = 0; i < x.rows(); ++i) sum += x(i, k);
    for (std::size_t i = 0; i < x.rows(); ++i) x(i, k) -= sum / static_cast<double>(x.rows());
  }
  return x;
}

double norm(const Matrix& x, std::size_t column) {
  const gsl_matrix_const_view view = x.view();
  const gsl_vector_const_view values = gsl_matrix_const_column(&view.matrix, column);
  return gsl_blas_dnrm2(&values.vector);
}

Matrix standardised(const Records& records, const Columns& columns) {
  Matrix x = matrix_of(records, columns);
  const auto scale = [&](std::size_t k, double factor) {
    for (std::size_t i = 0; i < x.rows(); ++i) x(i, k) *= factor;
  };
  for (std::size_t k = 0; k < x.columns(); ++k) {
    double largest = 0;
    for (std::size_t i = 0; i < x.rows(); ++i) largest = std::max(largest, std::abs(x(i, k)));
    scale(k, towards_one(largest));
  }
  const Matrix deviations = centred(x);
  for (std::size_t k = 0; k < x.columns(); ++k) {
    const double deviation = norm(deviations, k), rounding = 1e-12 * norm(x, k);
    scale(k, deviation > rounding ? 1 / deviation : 0);
  }
  return x;
}

bool varies(const Matrix& x, std::size_t column) { return norm(x, column) > 0; }

Matrix pseudo_inverse(Matrix x) {
  constexpr double determined = 1e-8;  // singular value, relative to the largest
  if (x.rows() < x.columns()) return transposed(pseudo_inverse(transposed(x)));  // as GSL requires
  const std::size_t columns = x.columns();
  Matrix v(columns, columns), result(columns, x.rows());
  std::vector<double> values(columns), scratch(columns);
  gsl_matrix_view u = x.view(), right = v.view();
  gsl_vector_view s = gsl_vector_view_array(values.data(), columns),
                  work = gsl_vector_view_array(scratch.data(), columns);
  gsl_linalg_SV_decomp(&u.matrix, &right.matrix, &s.vector, &work.vector);
  for (std::size_t k = 0; k < columns && values[k] > determined * values[0]; ++k)
    for (std::size_t i = 0; i < columns; ++i)
      for (std::size_t j = 0; j < x.rows(); ++j) result(i, j) += v(i, k) / values[k] * x(j, k);
  return result;
}

}  // namespace lorentz
