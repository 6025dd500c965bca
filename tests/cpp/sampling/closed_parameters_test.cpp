#include "sampling/closed_parameters.hpp"

#include <gtest/gtest.h>

namespace closed_parameters_test {

using namespace lorentz;

// Detected mistakes: the clock follows from the temperature of the particles instead of the higher one; the
// thermal flight of a particle follows from the higher temperature instead of that of the particles.
TEST(ClosedParameters, TimesFollowFromSpeeds) {
  const ClosedParameters parameters{
      .ring = {.cell_length = 2}, .temperature = 4, .scatterer_temperature = 16};
  EXPECT_EQ(parameters.hottest(), 16);
  EXPECT_EQ(parameters.longest_clock(), 0x1p31);
  EXPECT_EQ(parameters.thermal_flight(), 1);
}

}  // namespace closed_parameters_test
