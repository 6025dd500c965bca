#pragma once

#include "statistics/estimator.hpp"

namespace lorentz {

/// Correlation coefficient r over replicas of two tallies, in corrected records; NaN if one does not vary.
/// What is computed from both needs it for its error. Its own error is that of normal records, (1 -
/// r^2)/sqrt(R - 1).
Estimator correlation_coefficient(const Description& what, ScalarTally one, ScalarTally other,
                                  const Correction& correction);

}  // namespace lorentz
