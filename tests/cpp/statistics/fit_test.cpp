#include "statistics/fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace fit_test {

using namespace lorentz;

TEST(Fit, FindsLocalExponentsOfPositiveValues) {
  const std::vector<double> found =
      local_exponents(std::vector<double>{1, 2, 4, 8}, std::vector<double>{3, 12, 6, 0});
  EXPECT_NEAR(found[0], 2, 1e-15);
  EXPECT_NEAR(found[1], -1, 1e-15);
  EXPECT_TRUE(std::isnan(found[2]));
}

}  // namespace fit_test
