#include "sampling/momentum_bins.hpp"

#include <gtest/gtest.h>

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

TEST(MomentumBins, AreEven) {
  validate(MomentumBinParameters{.count = 4});
  EXPECT_TRUE(support::refused_as("--momentum-bins", [] { validate(MomentumBinParameters{.count = 5}); }));
}

}  // namespace momentum_bins_test
