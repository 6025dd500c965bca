#include "observables/steady_profile/profile.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace profile_test {

using namespace lorentz;

// Detected mistake: the line through one cell has the slope 0.
TEST(Profile, NoLineThroughOneCell) {
  EXPECT_TRUE(std::isnan(line_through({1, 2, 3}, 1, 1).slope));
  const Line line = line_through({9, 2, 4, 9}, 1, 2);
  EXPECT_NEAR(line.slope, 2, 1e-14);
  EXPECT_NEAR(line.intercept, 0, 1e-14);
}

// All particles are in the first cell. Detected mistake: the excess 5/0 is infinite.
TEST(DensityProfile, IsNoneWithoutParticlesInTheMiddle) {
  const DensityProfile profile(Values{5, 0, 0, 0, 0, 0, 0, 0});
  EXPECT_TRUE(std::isnan(profile.slope()));
  EXPECT_TRUE(std::isnan(profile.excess()[0]));
  EXPECT_TRUE(std::isnan(profile.excess()[1]));
}

}  // namespace profile_test
