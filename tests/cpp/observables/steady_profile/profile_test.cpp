#include "observables/steady_profile/profile.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace profile_test {

using namespace lorentz;

// Finds: the mean or the line added; the line through part of the cells.
TEST(Profile, MinusItsMeanOrItsLine) {
  EXPECT_EQ(average({1, 2, 6}), 3);
  EXPECT_EQ(minus_mean({1, 2, 6}), (Values{-2, -1, 3}));
  EXPECT_EQ(difference({5, 7}, {1, 9}), (Values{4, -2}));
  for (const double value : minus_line({3, 5, 7, 9})) EXPECT_NEAR(value, 0, 1e-14);
  const Values bent = minus_line({0, 0, 3});  // the line -1/2 + 3/2 i
  EXPECT_NEAR(bent[0], 0.5, 1e-14);
  EXPECT_NEAR(bent[1], -1, 1e-14);
}

// Finds: a line of slope 0 through one cell.
TEST(Profile, NoLineThroughOneCell) {
  EXPECT_TRUE(std::isnan(line_through({1, 2, 3}, 1, 1).slope));
  const Line line = line_through({9, 2, 4, 9}, 1, 2);
  EXPECT_NEAR(line.slope, 2, 1e-14);
  EXPECT_NEAR(line.intercept, 0, 1e-14);
}

// The middle half of 8 cells is 2 ... 5, where the density is 10 + i, with the mean 13.5; the ends would hold
// 10 and
// 17. Finds: a line through all cells; the slope per cell; the mean of all; the excess over the mean.
TEST(DensityProfile, SlopeOfTheMiddleAndExcessOfTheEnds) {
  const DensityProfile profile(Values{20, 0, 12, 13, 14, 15, 99, 34});
  EXPECT_NEAR(profile.slope(), 8 / 13.5, 1e-13);
  EXPECT_NEAR(profile.excess()[0], 20 / 10. - 1, 1e-13);
  EXPECT_NEAR(profile.excess()[1], 34 / 17. - 1, 1e-13);
}

// Particles in the first cell only. Finds: 5/0 as an infinity.
TEST(DensityProfile, IsNoneWithoutParticlesInTheMiddle) {
  const DensityProfile profile(Values{5, 0, 0, 0, 0, 0, 0, 0});
  EXPECT_TRUE(std::isnan(profile.slope()));
  EXPECT_TRUE(std::isnan(profile.excess()[0]));
  EXPECT_TRUE(std::isnan(profile.excess()[1]));
}

}  // namespace profile_test
