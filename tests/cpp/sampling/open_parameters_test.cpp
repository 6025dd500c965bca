#include "sampling/open_parameters.hpp"

#include <gtest/gtest.h>

namespace open_parameters_test {

using namespace lorentz;

// Detected mistakes: the starts cold and hot are exchanged; both use the left reservoir.
TEST(OpenParameters, StartsFromEquilibriumWithOneReservoir) {
  const auto temperature = [](const OpenParameters& parameters) {
    double sum = 0;
    for (const double U : parameters.start_point(10, {1, 0}).scatterers) sum += U * U;
    return sum / parameters.scattering.cells;
  };
  OpenParameters parameters;
  parameters.scattering.cells = 20'000;
  parameters.cell_length = 1e-4;
  constexpr double error = 0.01;  // relative standard error, sqrt(2/cells)
  for (const bool mirrored : {false, true}) {
    parameters.left.temperature = mirrored ? 900 : 100;
    parameters.right.temperature = mirrored ? 100 : 900;
    parameters.start = "cold";
    EXPECT_NEAR(temperature(parameters), 100, 100 * 4 * error);
    parameters.start = "hot";
    EXPECT_NEAR(temperature(parameters), 900, 900 * 4 * error);
  }
}

}  // namespace open_parameters_test
