#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace lorentz {

/// Sums per element, several kinds of them side by side, to which ranges of elements are added at a cost that
/// does not depend on their length: a difference array, summed once at the end. Single elements, which are
/// all that particles reach that scatter everywhere, have an array of their own, so that one place of memory
/// is touched.
template <std::size_t kinds = 1>
class RangeTally {
 public:
  using Values = std::array<double, kinds>;

  explicit RangeTally(std::size_t size) : singles_(size), steps_(size + 1) {}

  /// Adds the values to the elements first...last; nothing if first > last.
  void add(std::ptrdiff_t first, std::ptrdiff_t last, const Values& values) {
    if (first == last) {
      add(singles_[static_cast<std::size_t>(first)], values, 1);
    } else if (first < last) {
      add(steps_[static_cast<std::size_t>(first)], values, 1);
      add(steps_[static_cast<std::size_t>(last + 1)], values, -1);
    }
  }

  /// The elements being the intervals [k, k + 1): spreads totals evenly over [low, high], a point if low ==
  /// high.
  void spread(double low, double high, const Values& totals) {
    const auto end = static_cast<std::ptrdiff_t>(singles_.size());
    const auto first = std::min(static_cast<std::ptrdiff_t>(low), end - 1);  // low may be the end itself
    const auto last = std::max(first, static_cast<std::ptrdiff_t>(std::ceil(high)) - 1);
    if (first == last) {
      add(first, first, totals);
      return;
    }
    const auto part = [&](double length) {
      Values values{};
      add(values, totals, length / (high - low));
      return values;
    };
    add(first, first, part(static_cast<double>(first + 1) - low));
    add(first + 1, last - 1, part(1));
    add(last, last, part(high - static_cast<double>(last)));
  }

  /// Of one kind, by element.
  std::vector<double> sums(std::size_t kind = 0) const {
    std::vector<double> result;
    double ranges = 0;
    for (std::size_t i = 0; i < singles_.size(); ++i)
      result.push_back(singles_[i][kind] + (ranges += steps_[i][kind]));
    return result;
  }

 private:
  static void add(Values& sums, const Values& values, double factor) {
    for (std::size_t kind = 0; kind < kinds; ++kind) sums[kind] += factor * values[kind];
  }

  std::vector<Values> singles_, steps_;
};

}  // namespace lorentz
