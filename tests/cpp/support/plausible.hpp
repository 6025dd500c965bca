#pragma once

#include <gsl/gsl_cdf.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace support {

/// Two-sided test of chi^2: a value that is too small is implausible too.
inline testing::AssertionResult plausible(double chi_squared, double degrees_of_freedom) {
  const double below = gsl_cdf_chisq_P(chi_squared, degrees_of_freedom);
  const double above = gsl_cdf_chisq_Q(chi_squared, degrees_of_freedom);
  if (std::min(below, above) > 1e-5) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "chi^2 = " << chi_squared << " for " << degrees_of_freedom;
}

}  // namespace support
