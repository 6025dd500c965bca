#include "numerics/summation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace summation_test {

using namespace lorentz;

TEST(CompensatedSum, HasNoCancellation) {
  CompensatedSum sum;
  for (const double x : {1e16, 1.0, 3.0, -1e16, 0x1p-40}) sum.add(x);
  EXPECT_EQ(sum.value(), 4 + 0x1p-40);
}

// Detected mistake: a plain sum, which leaves a rounding error.
TEST(CompensatedSum, IsExactlyZeroWithoutItsOnlyTerm) {
  for (const double x : {0.7, 1e300, 1e-300, -3.0}) {
    CompensatedSum sum;
    for (const double each : {0.0, x, 0.0}) sum.add(each);
    EXPECT_EQ(sum.without(x), 0);
    EXPECT_EQ(sum.without(0), x);
  }
}

TEST(TowardsOne, IsThePowerOfTwoThatScalesToOne) {
  for (const double x : {3e307, 1e-300, 0.3, 1.0, 17.0}) {
    EXPECT_GE(x * towards_one(x), 1) << x;
    EXPECT_LT(x * towards_one(x), 2) << x;
    EXPECT_EQ(std::ilogb(towards_one(x)), std::log2(towards_one(x)));
  }
  EXPECT_EQ(towards_one(0), 1);
  EXPECT_TRUE(std::isfinite(towards_one(std::numeric_limits<double>::denorm_min())));
}

}  // namespace summation_test
