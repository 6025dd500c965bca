#include "sampling/momentum_bins.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/refusal.hpp"

namespace momentum_bins_test {

using namespace lorentz;

// Detected mistakes: the axis has the edges instead of the middles of the bins; bins begin at 0.
TEST(MomentumBins, LieAboutZero) {
  const MomentumBinParameters parameters{.count = 4, .max = 2};
  const Axis axis = momentum_axis(parameters.bins());
  EXPECT_EQ(axis.values, (std::vector{-1.5, -0.5, 0.5, 1.5}));
  EXPECT_EQ(axis.name, "momentum");
  EXPECT_EQ(axis.units, "momentum");
  EXPECT_EQ(parameters.bins().edge(2), 0);
}

// Detected mistakes: the last edge is limited in place of the width; there is no lower or no upper limit.
TEST(MomentumBins, HaveEdgesThatAreNumbers) {
  const auto check = [](double width) {
    return support::refusal([&] { validate(MomentumBinParameters{.count = 100'000, .max = 5e4 * width}); });
  };
  EXPECT_EQ(check(1.01e-290), "");
  EXPECT_EQ(check(0.99e290), "");
  EXPECT_NE(check(0.99e-290), "");
  EXPECT_EQ(
      check(1.01e290),
      "--momentum-max, --momentum-bins: the width of a bin would be 1.01e+290, which is not in [1e-290, "
      "1e+290]: outside, numbers lose precision or the run does not end. Choose other values or other "
      "units.");
  EXPECT_TRUE(std::isfinite(Bins(100'000, 5e4 * 0.99e290).edge(100'000)));
}

}  // namespace momentum_bins_test
