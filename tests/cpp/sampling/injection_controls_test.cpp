#include "sampling/injection_controls.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace injection_controls_test {

using namespace lorentz;

const OpenChain chain{{.cells = 3}, {.rate = 5, .temperature = 2}, {.rate = 0, .temperature = 8}};

// Detected mistakes: u is summed in place of |u|; the energy is u^2 instead of u^2/2; both ends are added
// together; the mean is not multiplied by the duration; the means of the other reservoir are subtracted.
TEST(InjectionControls, SumWhatEachReservoirInjectsMinusItsMean) {
  InjectionControls controls;
  controls.add(End::left, 4);
  controls.add(End::right, -3);
  controls.add(End::right, -1);
  const auto found = controls.deviations(chain, 10);
  EXPECT_EQ(found[0], 1 - 50);
  EXPECT_DOUBLE_EQ(found[1], 4 - 50 * std::sqrt(4 / std::numbers::pi));
  EXPECT_DOUBLE_EQ(found[2], 8 - 50 * 1);
  EXPECT_EQ(found[3], 2);  // nothing is expected from the right
  EXPECT_EQ(found[4], 4);
  EXPECT_EQ(found[5], 5);
}

}  // namespace injection_controls_test
