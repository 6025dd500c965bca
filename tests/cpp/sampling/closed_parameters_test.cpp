#include "sampling/closed_parameters.hpp"

#include <gtest/gtest.h>

namespace closed_parameters_test {

using namespace lorentz;

// Detected mistakes: the scatterers are left out; their mass is left out; a mean is stated although the total
// momentum is set to zero.
TEST(ClosedParameters, MeansOfTheStart) {
  ClosedParameters parameters;  // 220 particles at 500; M = 3
  EXPECT_EQ(parameters.mean_square_momentum(), 220 * 500);
  EXPECT_EQ(parameters.mean_energy(), 110 * 500);
  parameters.scatterer_temperature = 10;
  EXPECT_NEAR(parameters.mean_square_momentum(), 220 * 500 + 11 * 10 * 3, 1e-4);
  EXPECT_EQ(parameters.mean_energy(), 110 * 500 + 55);
  parameters.zero_total_momentum = true;
  EXPECT_EQ(parameters.mean_square_momentum(), 0);
  EXPECT_FALSE(parameters.mean_energy().has_value());
}

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
