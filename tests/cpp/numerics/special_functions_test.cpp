#include "numerics/special_functions.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sf_expint.h>
#include <gtest/gtest.h>

#include <cmath>

namespace special_functions_test {

using namespace lorentz;

// GSL's functions have relative errors of up to 5e-15.
TEST(ExponentialIntegral, AgreesWithGsl) {
  for (double x = 1e-300; x < 700; x *= 1.0173) {
    const double expected = gsl_sf_expint_E1(x);
    EXPECT_NEAR(exponential_integral(x) / expected, 1, 1e-14) << x;
  }
}

TEST(ChiSquareQuantile, AgreesWithGsl) {
  for (const double degrees : {1., 2., 3., 7., 31., 63., 64., 1000., 12345.})
    for (const double probability : {1e-10, 0.025, 0.5, 0.95, 0.975}) {
      const double expected = gsl_cdf_chisq_Qinv(probability, degrees);
      EXPECT_NEAR(chi_square_quantile(probability, degrees) / expected, 1, 1e-13)
          << degrees << ' ' << probability;
    }
  // Values by SciPy, as the iteration of GSL does not converge here.
  EXPECT_NEAR(chi_square_quantile(0.025, 1e6), 1002773.701467926, 1e-6);
  EXPECT_NEAR(chi_square_quantile(0.95, 1e6), 997674.9632764738, 1e-6);
}

TEST(FDistributionTail, AgreesWithGsl) {
  for (const double numerator : {1., 2., 4., 5., 30.})
    for (const double denominator : {1., 4., 59., 60., 251., 1000.})
      for (const double f : {0., 1e-10, 1e-3, 0.5, 0.99, 1., 1.01, 2., 5., 30.}) {
        const double expected = gsl_cdf_fdist_Q(f, numerator, denominator);
        EXPECT_NEAR(f_distribution_tail(f, numerator, denominator) / expected, 1, 1e-12)
            << f << ' ' << numerator << ' ' << denominator;
      }
  EXPECT_TRUE(std::isnan(f_distribution_tail(NAN, 2, 3)));
}

}  // namespace special_functions_test
