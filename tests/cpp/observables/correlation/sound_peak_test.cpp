#include "observables/correlation/sound_peak.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace {

using namespace lorentz;

// Detected mistakes: the last cell of an even ring, which belongs to both sides, counts twice; the sum over
// both sides is not halved.
TEST(SideMoment, IsHalfTheSumOverBothSides) {
  const std::vector<double> odd{1, 2, 4, 8, 16}, even{1, 2, 4, 8};
  EXPECT_EQ(side_moment(odd, 0, 0, 9), 15.5);
  EXPECT_EQ(side_moment(odd, 1, 0, 9), 0.5 * (2 + 2 + 8 + 32));
  EXPECT_EQ(side_moment(odd, 2, 2, 9), 0.5 * 4 * (1 + 16));
  EXPECT_EQ(side_moment(odd, 0, 1, 2), 0.5 * (2 + 8));
  EXPECT_EQ(side_moment(even, 1, 0, 9), 0.5 * (2 * 1 + 2 + 8));
}

std::vector<double> gaussian(double position, double deviation) {
  std::vector<double> profile;
  for (std::size_t d = 0; d < 200; ++d)
    profile.push_back(7 * std::exp(-0.5 * std::pow((static_cast<double>(d) - position) / deviation, 2)));
  return profile;
}

// The bias is that stated in the header, also if the expected width is wrong.
TEST(HalfHeightWidth, OfGaussianPeaks) {
  const double half = std::sqrt(2 * std::log(2.0));
  for (const double deviation : {8.0, 20.0})
    for (const double expected : {0.9, 1.0, 1.1}) {
      const double width = half_height_width(gaussian(90.3, deviation), 90.3, 7, expected * half * deviation);
      EXPECT_NEAR(width / (2 * half * deviation), 1.008, 0.01) << deviation << ' ' << expected;
    }
}

TEST(HalfHeightWidth, IsUndefinedWithoutFlanks) {
  // The range of the fit has two cells only.
  EXPECT_TRUE(std::isnan(half_height_width(gaussian(90, 2), 90, 7, 2)));
  // On one side the profile rises away from the given position.
  EXPECT_TRUE(std::isnan(half_height_width(gaussian(150, 9), 90, 7, 20)));
}

}  // namespace
