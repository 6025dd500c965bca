#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace lorentz {

/// Equal blocks of time from `begin` to `end`.
class Blocks {
 public:
  Blocks(double begin, double end, std::size_t count)
      : begin_(begin), end_(end), per_time_(static_cast<double>(count) / (end - begin)), count_(count) {}

  double length() const { return (end_ - begin_) / static_cast<double>(count_); }
  std::size_t count() const { return count_; }

  double edge(std::size_t block) const {
    return block == count_ ? end_ : begin_ + static_cast<double>(block) * length();
  }

  /// Block that contains a time in [begin, end).
  std::size_t operator[](double time) const {
    return std::min(static_cast<std::size_t>((time - begin_) * per_time_), count_ - 1);
  }

 private:
  double begin_, end_, per_time_;
  std::size_t count_;
};

/// Exact integrals over blocks of time of a piecewise constant quantity.
class TimeIntegral {
 public:
  explicit TimeIntegral(const Blocks& blocks)
      : since_(blocks.edge(0)), edge_(blocks.edge(1)), blocks_(blocks), sums_(blocks.count(), 0) {}

  /// Adds the time since the last call up to `until`, during which the quantity had this value. Times before
  /// that of the last call are ignored.
  void advance(double value, double until) {
    if (!(until > since_)) return;
    while (!(until < edge_)) [[unlikely]] {
      if (block_ == blocks_.count()) return;
      sum_ += value * (edge_ - since_);
      since_ = edge_;
      sums_[block_++] = std::exchange(sum_, 0);
      if (block_ < blocks_.count()) edge_ = blocks_.edge(block_ + 1);
    }
    sum_ += value * (until - since_);
    since_ = until;
  }

  /// Adds an amount at the time of the last call.
  void add(double amount) { sum_ += amount; }

  /// Integrals over the completed blocks; 0 for the others.
  const std::vector<double>& sums() const { return sums_; }

 private:
  double since_, edge_;  // time of the last call; end of the current block
  double sum_ = 0;       // integral over the current block
  std::size_t block_ = 0;
  Blocks blocks_;
  std::vector<double> sums_;
};

}  // namespace lorentz
