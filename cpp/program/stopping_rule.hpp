#pragma once

#include <cstdint>

namespace lorentz {

/// Sequential stopping rule of a run with a target error.
///
/// The standard error of R replicas is an estimate. Runs that stop as soon as it falls below the target stop
/// where it is too small, most of all with few replicas. Therefore a run needs 64 replicas and stops at the
/// first look at which the upper 95 % confidence bound of the error is below the target; for normal records
/// s^2/sigma^2 is a chi-square variable with R-1 degrees of freedom [eq. 48]. The looks take place at
/// fixed numbers of replicas, so the result depends neither on the number of threads nor on interruptions.
///
/// Because R depends on the data, estimates have a bias of order 1/R. For records with skewness g, excess
/// kurtosis k and coefficient of variation v, the delta method gives a bias of the mean of -(g - 2v) sigma/R
/// under a target relative to the mean and -g sigma/R under one with a fixed scale [eq. 49], and reduces the
/// square of the standard error by the part (k + 2)/R. With 64 or more replicas, means and errors are at
/// least as good as those of a fixed number of 32 (tests/cpp/program/stopping_rule_test.cpp). Chow & Robbins,
/// Ann. Math. Stat. 36, 457 (1965); Glynn & Whitt, Ann. Appl. Probab. 2, 180 (1992).
struct StoppingRule {
  static constexpr std::uint64_t least = 64;  // replicas needed to reach a target

  std::uint64_t batch = 16;        // replicas are added in whole batches
  std::uint64_t most = 1'000'000;  // largest number of replicas, but at least one batch

  /// Number of replicas at the next look: `least` first, then one batch more, later an eighth more, because
  /// the time of a jackknife is proportional to the number of replicas.
  std::uint64_t next_look(std::uint64_t used) const;

  /// excess: ratio of the estimated standard error to the target.
  static bool reached(std::uint64_t used, double excess);
};

}  // namespace lorentz
