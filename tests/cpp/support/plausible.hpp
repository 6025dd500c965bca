#pragma once

#include <gsl/gsl_cdf.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace support {

/// Two-sided test of chi^2: a value that is too small is implausible too.
inline testing::AssertionResult plausible(double chi_squared, double degrees_of_freedom) {
  const double below = gsl_cdf_chisq_P(chi_squared, degrees_of_freedom);
  const double above = gsl_cdf_chisq_Q(chi_squared, degrees_of_freedom);
  if (std::min(below, above) > 1e-5) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "chi^2 = " << chi_squared << " for " << degrees_of_freedom;
}

/// chi^2 of counts that are equal on average.
inline double unevenness(const std::vector<double>& counts) {
  const double sum = std::accumulate(counts.begin(), counts.end(), 0.0);
  const double expected = sum / static_cast<double>(counts.size());
  double squares = 0;
  for (const double count : counts) squares += (count - expected) * (count - expected);
  return squares / expected;
}

}  // namespace support
