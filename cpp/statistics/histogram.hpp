#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lorentz {

/// An even number of equal bins on [-max, max], so that one edge is exactly 0. A value is divided by the bin
/// width through a multiplication, whose rounding defines the other edges.
class Bins {
 public:
  Bins(std::size_t count, double max)
      : half_(count / 2), max_(max), per_unit_(static_cast<double>(half_) / max) {}

  std::size_t count() const { return 2 * half_; }
  double width() const { return max_ / static_cast<double>(half_); }
  double edge(std::size_t bin) const {
    return max_ * (static_cast<double>(bin) - static_cast<double>(half_)) / static_cast<double>(half_);
  }

  /// Bin of a value; count() outside. The edge 0 belongs to the bin above it, every other edge to the bin
  /// farther from 0. The sign is handled without a branch, because branch prediction fails for random signs.
  std::size_t operator[](double value) const {
    const double place = value * per_unit_;
    if (!(std::abs(place) < static_cast<double>(half_))) return count();
    const auto below = static_cast<std::int64_t>(value < 0);
    return half_ + static_cast<std::size_t>(static_cast<std::int64_t>(place) - below);
  }

  std::vector<double> middles() const {
    std::vector<double> result;
    for (std::size_t bin = 0; bin < count(); ++bin) result.push_back(0.5 * (edge(bin) + edge(bin + 1)));
    return result;
  }

 private:
  std::size_t half_;
  double max_, per_unit_;
};

/// Sums of weights by bin.
class Histogram {
 public:
  explicit Histogram(const Bins& bins) : bins_(bins), weights_(bins.count(), 0) {}

  void add(double value, double weight = 1) {
    const std::size_t bin = bins_[value];
    if (bin < weights_.size()) weights_[bin] += weight;
  }

  const std::vector<double>& weights() const { return weights_; }

 private:
  Bins bins_;
  std::vector<double> weights_;
};

}  // namespace lorentz
