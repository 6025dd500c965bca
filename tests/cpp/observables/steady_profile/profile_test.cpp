#include "observables/steady_profile/profile.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace profile_test {

using namespace lorentz;

// Detected mistakes: the mean or the line is added instead of subtracted; the line is fitted to part of the
// cells.
TEST(Profile, MinusItsMeanOrItsLine) {
  EXPECT_EQ(average({1, 2, 6}), 3);
  EXPECT_EQ(minus_mean({1, 2, 6}), (Values{-2, -1, 3}));
  EXPECT_EQ(difference({5, 7}, {1, 9}), (Values{4, -2}));
  for (const double value : minus_line({3, 5, 7, 9})) EXPECT_NEAR(value, 0, 1e-14);
  const Values bent = minus_line({0, 0, 3});  // the line -1/2 + 3/2 i
  EXPECT_NEAR(bent[0], 0.5, 1e-14);
  EXPECT_NEAR(bent[1], -1, 1e-14);
}

// Detected mistake: the line through one cell has the slope 0.
TEST(Profile, NoLineThroughOneCell) {
  EXPECT_TRUE(std::isnan(line_through({1, 2, 3}, 1, 1).slope));
  const Line line = line_through({9, 2, 4, 9}, 1, 2);
  EXPECT_NEAR(line.slope, 2, 1e-14);
  EXPECT_NEAR(line.intercept, 0, 1e-14);
}

// The middle half of 8 cells has the indices i = 2 ... 5 and the density 10 + i, with the mean 13.5. On its
// line both ends would have the densities 10 and 17. Detected mistakes: the line is fitted to all cells; the
// slope is per cell; it is divided by the mean of all cells; the excess is relative to the mean.
TEST(DensityProfile, SlopeOfTheMiddleAndExcessOfTheEnds) {
  const DensityProfile profile(Values{20, 0, 12, 13, 14, 15, 99, 34});
  EXPECT_NEAR(profile.slope(), 8 / 13.5, 1e-13);
  EXPECT_NEAR(profile.excess()[0], 20 / 10. - 1, 1e-13);
  EXPECT_NEAR(profile.excess()[1], 34 / 17. - 1, 1e-13);
}

// All particles are in the first cell. Detected mistake: the excess 5/0 is infinite.
TEST(DensityProfile, IsNoneWithoutParticlesInTheMiddle) {
  const DensityProfile profile(Values{5, 0, 0, 0, 0, 0, 0, 0});
  EXPECT_TRUE(std::isnan(profile.slope()));
  EXPECT_TRUE(std::isnan(profile.excess()[0]));
  EXPECT_TRUE(std::isnan(profile.excess()[1]));
}

}  // namespace profile_test
