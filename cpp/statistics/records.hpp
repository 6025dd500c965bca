#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace lorentz {

/// Matrix of measurements: one row of sums per replica, in the order of the replicas.
class Records {
 public:
  explicit Records(std::size_t width) : width_(width) {}

  /// Throws std::invalid_argument if the row does not have the width of the others.
  void append(std::span<const double> row);

  /// Replaces a column by that of other records of the same shape.
  void copy_column(const Records& others, std::size_t column) {
    for (std::size_t i = column; i < rows_.size(); i += width_) rows_[i] = others.rows_[i];
  }

  std::size_t size() const { return rows_.size() / width_; }
  std::size_t width() const { return width_; }
  std::span<const double> operator[](std::size_t replica) const {
    return std::span(rows_).subspan(replica * width_, width_);
  }
  const std::vector<double>& values() const { return rows_; }  // row-major

  /// Mean over replicas; NaN without replicas.
  std::vector<double> mean() const;

 private:
  std::size_t width_;
  std::vector<double> rows_;
};

}  // namespace lorentz
