#include "sampling/open_parameters.hpp"

#include <gtest/gtest.h>

#include "support/refusal.hpp"

namespace open_parameters_test {

using namespace lorentz;
using support::refused_as;

// Detected mistake: the starts empty and warm are exchanged.
TEST(OpenParameters, Starts) {
  OpenParameters parameters{.scattering = {.cells = 5}};
  EXPECT_GT(parameters.start_point(10, {1, 0}).particles.size(), 10U);
  parameters.start = "empty";
  const PhasePoint empty = parameters.start_point(10, {1, 0});
  EXPECT_TRUE(empty.particles.empty());
  EXPECT_EQ(empty.scatterers, std::vector<double>(5, 0));
}

// Detected mistakes: the starts cold and hot are exchanged; both use the left reservoir.
TEST(OpenParameters, StartsFromEquilibriumWithOneReservoir) {
  const auto temperature = [](const OpenParameters& parameters) {
    double sum = 0;
    for (const double U : parameters.start_point(10, {1, 0}).scatterers) sum += U * U;
    return sum / parameters.scattering.cells;
  };
  OpenParameters parameters{.scattering = {.cells = 20'000}, .cell_length = 1e-4};
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

StationaryParameters stationary(double relaxation_time, double observation_time) {
  StationaryParameters parameters;
  parameters.relaxation_time = relaxation_time;
  parameters.observation_time = observation_time;
  return parameters;
}

// Detected mistake: the observation is counted from 0 instead of the end of the relaxation.
TEST(OpenParameters, WindowFollowsTheRelaxation) {
  const Window window = stationary(10, 3).window();
  EXPECT_EQ(window.begin, 10);
  EXPECT_EQ(window.end, 13);
}

// Detected mistakes: every particle is assumed to stay for the whole run; only the hotter reservoir is
// checked.
TEST(OpenParameters, LimitTheNumberOfParticles) {
  // 1e8 particles per unit time stay for a time 50 L/sqrt(T), which is 5.5 on a chain of length 1 and longer
  // than the run of 100 on one of length 30.
  OpenParameters parameters{.left = {1e8, 900. / 11}};
  EXPECT_NO_THROW(validate(parameters, 100, "--times"));
  parameters.cell_length = 1;
  EXPECT_TRUE(refused_as("--nu-left, --nu-right", [&] { validate(parameters, 100, "--times"); }));
}

// Detected mistakes: the colder reservoir is used; the relaxation time is compared in place of the end of the
// run.
TEST(OpenParameters, RequireAClockThatResolvesFlightsAndWindow) {
  OpenParameters parameters{.cell_length = 1, .left = {1, 1}, .right = {1, 100}};
  EXPECT_NO_THROW(validate(parameters, 1e11, "--times"));
  EXPECT_TRUE(refused_as("--cell-length, --times", [&] { validate(parameters, 1.1e11, "--times"); }));
  EXPECT_NO_THROW(validate(stationary(1e5, 1.1e-7)));
  EXPECT_TRUE(refused_as("--relaxation-time, --observation-time", [] { validate(stationary(1e5, 0.9e-7)); }));
}

}  // namespace open_parameters_test
