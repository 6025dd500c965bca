#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace lorentz {

/// Arrays of sums, `kinds` of them, to which values are added over a range of elements at a cost that does
/// not depend on its length: a difference array, summed once at the end [eq. 34]. Single elements, the only
/// ranges at gamma = N, are added to an array of their own, which touches one cache line instead of two.
template <std::size_t kinds = 1>
class RangeTally {
 public:
  using Values = std::array<double, kinds>;

  explicit RangeTally(std::size_t size) : singles_(size), steps_(size + 1) {}

  /// Adds the values to the elements first, ..., last; to none if first > last.
  void add(std::ptrdiff_t first, std::ptrdiff_t last, const Values& values) {
    if (first == last) {
      add(singles_[static_cast<std::size_t>(first)], values, 1);
    } else if (first < last) {
      add(steps_[static_cast<std::size_t>(first)], values, 1);
      add(steps_[static_cast<std::size_t>(last + 1)], values, -1);
    }
  }

  /// Distributes totals evenly over [low, high], where element k is the interval [k, k + 1). For low == high
  /// all goes to one element.
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

  /// Sums of one kind by element.
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
