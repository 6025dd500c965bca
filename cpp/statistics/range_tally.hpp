#pragma once

#include <algorithm>
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

  /// The elements being the intervals [k, k + 1): spreads a total evenly over [low, high], a point if low ==
  /// high.
  void spread(double low, double high, double total) {
    const auto end = static_cast<std::ptrdiff_t>(steps_.size()) - 1;
    const auto first = std::min(static_cast<std::ptrdiff_t>(low), end - 1);  // low may be the end itself
    const auto last = std::max(first, static_cast<std::ptrdiff_t>(std::ceil(high)) - 1);
    if (first == last) {
      add(first, first, total);
      return;
    }
    const double density = total / (high - low);
    add(first, first, density * (static_cast<double>(first + 1) - low));
    add(first + 1, last - 1, density);
    add(last, last, density * (high - static_cast<double>(last)));
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
