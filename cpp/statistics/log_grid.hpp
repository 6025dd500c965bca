#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "model/portable.hpp"

namespace lorentz {

/// Points that divide every decade from `first` upwards into equal factors.
class LogGrid {
 public:
  LogGrid(double first, double decades, std::size_t points_per_decade)
      : log_first_(portable::log(first)),
        steps_per_unit_(static_cast<double>(points_per_decade) / portable::log(10.0)),
        steps_(static_cast<std::size_t>(std::llround(decades * static_cast<double>(points_per_decade)))) {}

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

  /// The interval of the value whose logarithm is given; those outside count to the first or the last.
  std::size_t interval(double log_value) const {
    const double step = (log_value - log_first_) * steps_per_unit_;
    return static_cast<std::size_t>(std::clamp(step, 0.0, static_cast<double>(steps_) - 0.5));
  }

  std::size_t intervals() const { return steps_; }

 private:
  double point(double step) const { return portable::exp(log_first_ + step / steps_per_unit_); }

  double log_first_, steps_per_unit_;
  std::size_t steps_;
};

}  // namespace lorentz
