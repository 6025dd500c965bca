#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace lorentz {

/// Geometric means of neighbouring points, where slopes between them belong.
inline std::vector<double> geometric_middles(const std::vector<double>& points) {
  std::vector<double> middles;
  for (std::size_t k = 0; k + 1 < points.size(); ++k)
    middles.push_back(std::sqrt(points[k]) * std::sqrt(points[k + 1]));
  return middles;
}

/// Points in geometric progression from `first` upwards.
class LogGrid {
 public:
  LogGrid(double first, double decades, std::size_t points_per_decade)
      : log_first_(std::log(first)),
        steps_per_unit_(static_cast<double>(points_per_decade) / std::log(10.0)),
        steps_(static_cast<std::size_t>(std::llround(decades * static_cast<double>(points_per_decade)))) {
    make_table();
  }

  /// All points, both ends included.
  std::vector<double> points() const {
    std::vector<double> result;
    for (std::size_t i = 0; i <= steps_; ++i) result.push_back(point(static_cast<double>(i)));
    return result;
  }

  /// Geometric mean of the ends of every interval.
  std::vector<double> middles() const {
    std::vector<double> result;
    for (std::size_t i = 0; i < steps_; ++i) result.push_back(point(static_cast<double>(i) + 0.5));
    return result;
  }

  /// Interval of a positive value, its lower point included; values outside belong to the first or the last
  /// interval. A table lookup by the leading bits of the value replaces the slower logarithm.
  std::size_t interval(double value) const {
    const Cell& cell = table_[static_cast<std::size_t>(std::clamp(cell_of(value), first_, last_) - first_)];
    return cell.interval + (value >= cell.next_point ? 1 : 0);
  }

  std::size_t intervals() const { return steps_; }

 private:
  /// Range of numbers with the same sign, exponent and leading bits of the fraction.
  struct Cell {
    double next_point;     // above the lower end of the cell; NaN, never reached, in the last interval
    std::size_t interval;  // that contains the lower end
  };

  std::int64_t cell_of(double value) const { return std::bit_cast<std::int64_t>(value) >> ignored_bits_; }

  /// Fills the table with the widest cells that contain at most one point each.
  void make_table() {
    const double factor = std::exp(1 / steps_per_unit_);
    for (double width = 1; 1 + width >= factor; width /= 2) --ignored_bits_;
    const std::vector<double> edges = points();
    first_ = cell_of(edges.front());
    last_ = cell_of(edges.back());
    std::size_t interval = 0;
    for (std::int64_t cell = first_; cell <= last_; ++cell) {
      const auto low = std::bit_cast<double>(cell << ignored_bits_);
      while (interval + 1 < steps_ && edges[interval + 1] <= low) ++interval;
      const bool last = interval + 1 == steps_;
      table_.push_back({last ? std::numeric_limits<double>::quiet_NaN() : edges[interval + 1], interval});
    }
  }

  double point(double step) const { return std::exp(log_first_ + step / steps_per_unit_); }

  double log_first_, steps_per_unit_;
  std::size_t steps_;
  int ignored_bits_ = 52;  // trailing bits of a number that do not select its cell
  std::int64_t first_ = 0, last_ = 0;
  std::vector<Cell> table_;
};

}  // namespace lorentz
