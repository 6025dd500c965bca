#pragma once

#include <gsl/gsl_blas.h>
#include <gsl/gsl_linalg.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "numerics/gsl.hpp"

namespace lorentz {

/// Matrix, stored row by row, with at least one row and one column where GSL is called.
class Matrix {
 public:
  Matrix(std::size_t rows, std::size_t columns)
      : rows_(rows), columns_(columns), values_(rows * columns, 0) {}

  std::size_t rows() const { return rows_; }
  std::size_t columns() const { return columns_; }
  double& operator()(std::size_t i, std::size_t j) { return values_[i * columns_ + j]; }
  double operator()(std::size_t i, std::size_t j) const { return values_[i * columns_ + j]; }
  std::span<double> row(std::size_t i) { return std::span(values_).subspan(i * columns_, columns_); }
  std::span<const double> row(std::size_t i) const {
    return std::span(values_).subspan(i * columns_, columns_);
  }

  gsl_matrix_view view() { return gsl_matrix_view_array(values_.data(), rows_, columns_); }
  gsl_matrix_const_view view() const { return gsl_matrix_const_view_array(values_.data(), rows_, columns_); }

 private:
  std::size_t rows_, columns_;
  std::vector<double> values_;
};

inline Matrix transposed(const Matrix& matrix) {
  Matrix result(matrix.columns(), matrix.rows());
  for (std::size_t i = 0; i < result.rows(); ++i)
    for (std::size_t j = 0; j < result.columns(); ++j) result(i, j) = matrix(j, i);
  return result;
}

/// result += a b.
inline void add_product(const Matrix& a, const Matrix& b, Matrix& result) {
  const gsl_matrix_const_view left = a.view(), right = b.view();
  gsl_matrix_view sum = result.view();
  gsl_blas_dgemm(CblasNoTrans, CblasNoTrans, 1, &left.matrix, &right.matrix, 1, &sum.matrix);
}

/// LU factors of a square matrix, to solve linear systems.
class LuFactors {
 public:
  explicit LuFactors(Matrix matrix) : factors_(std::move(matrix)), permutation_(factors_.rows()) {
    gsl_matrix_view view = factors_.view();
    int sign = 0;
    gsl_linalg_LU_decomp(&view.matrix, permutation_.get(), &sign);
  }

  /// Replaces the right-hand side b by the solution.
  void solve(std::span<double> b) const {
    const gsl_matrix_const_view view = factors_.view();
    gsl_vector_view x = gsl_vector_view_array(b.data(), b.size());
    gsl_linalg_LU_svx(&view.matrix, permutation_.get(), &x.vector);
  }

 private:
  Matrix factors_;
  GslObject<gsl_permutation, gsl_permutation_alloc, gsl_permutation_free> permutation_;
};

}  // namespace lorentz
