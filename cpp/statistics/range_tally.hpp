#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace lorentz {

/// Sums per element, to which ranges of elements are added at a cost that does not depend on their length: a
/// difference array, summed once at the end.
class RangeTally {
 public:
  explicit RangeTally(std::size_t size) : steps_(size + 1, 0) {}

  /// Adds the value to the elements first...last; nothing if first > last.
  void add(std::ptrdiff_t first, std::ptrdiff_t last, double value) {
    if (first > last) return;
    steps_[static_cast<std::size_t>(first)] += value;
    steps_[static_cast<std::size_t>(last + 1)] -= value;
  }

  /// The elements being the intervals [k, k + 1): adds to each the value times its overlap with [low, high].
  void add_overlap(double low, double high, double value) {
    const auto first = static_cast<std::ptrdiff_t>(low),
               last = static_cast<std::ptrdiff_t>(std::ceil(high)) - 1;
    if (!(low < high)) return;
    add(first, last, value);
    add(first, first, -value * (low - static_cast<double>(first)));
    add(last, last, -value * (static_cast<double>(last + 1) - high));
  }

  std::vector<double> sums() const {
    std::vector<double> result;
    double sum = 0;
    for (std::size_t i = 0; i + 1 < steps_.size(); ++i) result.push_back(sum += steps_[i]);
    return result;
  }

 private:
  std::vector<double> steps_;
};

}  // namespace lorentz
