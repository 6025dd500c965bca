#include "statistics/fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace fit_test {

using namespace lorentz;

// The range of the fit includes both of its ends and nothing beyond. Detected mistakes: an end is excluded;
// all points are used.
TEST(Fit, UsesThePointsInItsRange) {
  const std::vector<double> x = {1, 2, 4, 8}, y = {1000, 1, 16, 0};
  EXPECT_NEAR(fit_power(x, y, 2, 4), 4, 1e-13);
  EXPECT_NEAR(fit_logarithm(x, y, 2, 4), 15 / std::log(2), 1e-13);
}

TEST(Fit, FindsLocalExponentsOfPositiveValues) {
  const std::vector<double> found =
      local_exponents(std::vector<double>{1, 2, 4, 8}, std::vector<double>{3, 12, 6, 0});
  EXPECT_NEAR(found[0], 2, 1e-15);
  EXPECT_NEAR(found[1], -1, 1e-15);
  EXPECT_TRUE(std::isnan(found[2]));
}

}  // namespace fit_test
