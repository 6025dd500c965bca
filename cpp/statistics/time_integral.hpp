#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace lorentz {

/// Equal blocks of time from `begin` to `end`.
class Blocks {
 public:
  Blocks(double begin, double end, std::size_t count) : begin_(begin), end_(end), count_(count) {}

  double length() const { return (end_ - begin_) / static_cast<double>(count_); }
  std::size_t count() const { return count_; }
  bool contain(double time) const { return time >= begin_ && time < end_; }

  double edge(std::size_t block) const {
    return block == count_ ? end_ : begin_ + static_cast<double>(block) * length();
  }

  /// Of a time that they contain.
  std::size_t operator[](double time) const {
    return std::min(static_cast<std::size_t>((time - begin_) / length()), count_ - 1);
  }

 private:
  double begin_, end_;
  std::size_t count_;
};

/// Integral over blocks of time of a quantity that is constant between its changes.
class TimeIntegral {
 public:
  explicit TimeIntegral(const Blocks& blocks)
      : blocks_(blocks), since_(blocks.edge(0)), sums_(blocks.count(), 0) {}

  /// The quantity had this value up to a time, no earlier than the one before.
  void hold(double value, double until) {
    while (since_ < until && block_ < blocks_.count()) {
      const double edge = blocks_.edge(block_ + 1), step = std::min(until, edge);
      sums_[block_] += value * (step - since_);
      since_ = step;
      if (step == edge) ++block_;
    }
  }

  const std::vector<double>& sums() const { return sums_; }

 private:
  Blocks blocks_;
  double since_;
  std::size_t block_ = 0;
  std::vector<double> sums_;
};

}  // namespace lorentz
