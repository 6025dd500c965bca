#pragma once

#include <cstdint>

namespace lorentz {

/// When a run with a target error ends.
///
/// The standard error of R replicas is an estimate. Runs that end as soon as it falls below the target end
/// where it came out too small, most of all with few replicas. So the error is looked at from 64 replicas on,
/// and a run ends at the first look where the target is above the upper 95 % confidence bound of the error:
/// for normal records s^2/sigma^2 is a chi-square variable with R-1 degrees of freedom. The error is
/// looked at after given numbers of replicas, so the end depends neither on the number of threads nor on
/// interruptions.
///
/// A number of replicas that depends on the data leaves an effect of the order 1/R on the estimate: with the
/// skewness g, the excess kurtosis k and the coefficient of variation v of the records, the delta method
/// gives the mean a bias of -(g - 2v) sigma/R under a relative target, -g sigma/R under an absolute one, and
/// lowers the square of its standard error by the part (k + 2)/R. With 64 replicas and more, means and errors
/// stay at least as good as those of 32 replicas given in advance (tests/cpp/stopping_rule_test.cpp). Chow &
/// Robbins, Ann. Math. Stat. 36, 457 (1965); Glynn & Whitt, Ann. Appl. Probab. 2, 180 (1992).
struct StoppingRule {
  static constexpr std::uint64_t least = 64;  // replicas before a target counts as reached

  std::uint64_t batch;  // replicas are added in whole batches
  std::uint64_t most;   // replicas in all, unless one batch is more

  /// Replicas at which the error is looked at next: `least` at first, then a batch more, later an eighth
  /// more, as the jackknife takes a time in proportion to what there is.
  std::uint64_t next_look(std::uint64_t used) const;

  /// excess: estimated standard error over the target.
  static bool reached(std::uint64_t used, double excess);

  /// Replicas after which the run ends, or gives up, if the error falls as one over the square root of their
  /// number.
  struct Forecast {
    std::uint64_t likely;
    std::uint64_t low, high;  // 95 % prediction interval for normal records; less for skewed ones
  };
  Forecast forecast(std::uint64_t used, double excess) const;

 private:
  std::uint64_t end(std::uint64_t used, double excess) const;
};

}  // namespace lorentz
