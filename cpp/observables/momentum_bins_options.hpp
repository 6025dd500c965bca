#pragma once

#include "program/errors.hpp"
#include "program/options.hpp"
#include "statistics/histogram.hpp"

namespace lorentz {

/// --momentum-bins and --momentum-max: equal bins of momentum with an edge at 0.
class MomentumBinsOptions {
 public:
  /// The values are the defaults of those options.
  MomentumBinsOptions(std::uint32_t count, double max) : count_(count), max_(max) {}

  void declare(Options& options) {
    options.integer("--momentum-bins", count_, {2, 100'000}, "Number of bins of momentum, even");
    options.real("--momentum-max", max_, positive, "The bins span from minus this momentum to plus it");
  }

  /// Throws UsageError if the number is odd, as no edge would lie at 0.
  void validate() const {
    if (count_ % 2 != 0)
      throw UsageError(
          "--momentum-bins is odd: no edge would lie at 0, where the flux jumps. Choose an even number.");
  }

  Bins bins() const { return {count_, max_}; }

 private:
  std::uint32_t count_;
  double max_;
};

}  // namespace lorentz
