#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "model/portable.hpp"

namespace lorentz {

/// Points that divide every decade from `first` upwards into equal factors.
class LogGrid {
 public:
  LogGrid(double first, double decades, std::size_t points_per_decade)
      : log_first_(portable::log(first)),
        steps_per_unit_(static_cast<double>(points_per_decade) / portable::log(10.0)),
        steps_(static_cast<std::size_t>(std::llround(decades * static_cast<double>(points_per_decade)))) {
    make_table();
  }

  /// All points, ends included.
  std::vector<double> points() const {
    std::vector<double> result;
    for (std::size_t i = 0; i <= steps_; ++i) result.push_back(point(static_cast<double>(i)));
    return result;
  }

  /// Geometric middle of every interval.
  std::vector<double> middles() const {
    std::vector<double> result;
    for (std::size_t i = 0; i < steps_; ++i) result.push_back(point(static_cast<double>(i) + 0.5));
    return result;
  }

  /// The interval of a positive value, its lower point included; values outside count to the first or the
  /// last. Without a logarithm.
  std::size_t interval(double value) const {
    const Cell& cell = table_[static_cast<std::size_t>(std::clamp(cell_of(value), first_, last_) - first_)];
    return cell.interval + (value >= cell.next_point ? 1 : 0);
  }

  std::size_t intervals() const { return steps_; }

 private:
  /// Numbers that agree in sign, exponent and the leading bits of the fraction.
  struct Cell {
    double next_point;     // after the lower end of the cell; NaN, which no value reaches, in the last one
    std::size_t interval;  // of that end
  };

  std::int64_t cell_of(double value) const { return std::bit_cast<std::int64_t>(value) >> ignored_bits_; }

  /// Cells so narrow that none holds two points.
  void make_table() {
    const double factor = portable::exp(1 / steps_per_unit_);
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

  double point(double step) const { return portable::exp(log_first_ + step / steps_per_unit_); }

  double log_first_, steps_per_unit_;
  std::size_t steps_;
  int ignored_bits_ = 52;  // of a number, the last ones
  std::int64_t first_, last_;
  std::vector<Cell> table_;
};

}  // namespace lorentz
