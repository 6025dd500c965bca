#pragma once

#include <cstddef>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "statistics/fit.hpp"
#include "statistics/tally.hpp"

namespace lorentz {

/// Values of a quantity by cell.
using Values = std::vector<double>;

inline double average(const Values& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

inline Values difference(Values values, const Values& others) {
  for (std::size_t i = 0; i < values.size(); ++i) values[i] -= others[i];
  return values;
}

inline Values minus_mean(const Values& values) {
  return difference(values, Values(values.size(), average(values)));
}

/// Least-squares line through the values of a range of cells, against the cell number; NaN for fewer than two
/// cells.
inline Line line_through(const Values& values, std::size_t first, std::size_t count) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (count < 2) return {none, none};
  const Values x = numbered_axis("", "", values.size()).values;
  return fit_line(std::span(x).subspan(first, count), std::span(values).subspan(first, count));
}

inline Values minus_line(Values values) {
  const Line line = line_through(values, 0, values.size());
  for (std::size_t cell = 0; cell < values.size(); ++cell)
    values[cell] -= line.intercept + line.slope * static_cast<double>(cell);
  return values;
}

/// Density of an open chain relative to the least-squares line through its middle half. NaN where the line is
/// 0.
class DensityProfile {
 public:
  explicit DensityProfile(std::span<const double> density)
      : values_(density.begin(), density.end()),
        middle_(0.5 * static_cast<double>(values_.size() - 1)),
        bulk_(line_through(values_, values_.size() / 4, values_.size() - 2 * (values_.size() / 4))) {}

  /// Change of the line over the length of the chain, relative to its value in the middle.
  double slope() const {
    return ratio(bulk_.slope * static_cast<double>(values_.size()), bulk_.intercept + bulk_.slope * middle_);
  }
  /// Densities of the first and the last cell relative to the line, minus 1.
  Values excess() const {
    return {ratio(values_.front(), bulk_.intercept) - 1,
            ratio(values_.back(), bulk_.intercept + bulk_.slope * 2 * middle_) - 1};
  }

 private:
  static double ratio(double a, double b) {
    return b == 0 ? std::numeric_limits<double>::quiet_NaN() : a / b;
  }

  Values values_;
  double middle_;
  Line bulk_;
};

}  // namespace lorentz
