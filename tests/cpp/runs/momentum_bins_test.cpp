#include "runs/momentum_bins.hpp"

#include <gtest/gtest.h>

#include "support/refusal.hpp"

namespace {

using namespace lorentz;

// Mutants: the edges on the axis; bins from 0 on.
TEST(MomentumBins, LieAboutZero) {
  const MomentumBinParameters parameters{.count = 4, .max = 2};
  const Axis axis = momentum_axis(parameters.bins());
  EXPECT_EQ(axis.values, (std::vector{-1.5, -0.5, 0.5, 1.5}));
  EXPECT_EQ(axis.name, "momentum");
  EXPECT_EQ(axis.units, "momentum");
  EXPECT_EQ(parameters.bins().edge(2), 0);
}

TEST(MomentumBins, AreReadFromTheCommandLine) {
  MomentumBinParameters parameters;
  EXPECT_EQ(parameters.bins().count(), 100U);
  EXPECT_EQ(parameters.bins().edge(100), 60);
  Options options("example", "An example");
  declare(options, parameters);
  const char* words[] = {"example", "--momentum-bins", "6", "--momentum-max", "3"};
  options.parse(5, words, "");
  EXPECT_EQ(momentum_axis(parameters.bins()).values, (std::vector{-2.5, -1.5, -0.5, 0.5, 1.5, 2.5}));
}

// Mutant: validate() empty, so that 7 bins would silently become 6.
TEST(MomentumBins, AreEven) {
  EXPECT_NO_THROW(validate(MomentumBinParameters{.count = 6}));
  EXPECT_TRUE(support::refused_as("--momentum-bins is odd: no edge would lie at 0",
                                  [] { validate(MomentumBinParameters{.count = 7}); }));
}

}  // namespace
