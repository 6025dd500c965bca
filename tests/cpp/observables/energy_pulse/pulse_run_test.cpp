#include "observables/energy_pulse/pulse_run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "engine/closed_start.hpp"
#include "support/refusal.hpp"

namespace pulse_run_test {

using namespace lorentz;
using support::refused_as;

const StreamKey key{3, 1};
const PulseParameters small{.ring = {.scattering = {.cells = 9}, .particles_per_cell = 4},
                            .times = {0.005, 0.02}};

void nothing(double) {}

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

/// Initial energy of the middle cell: four particles and a scatterer at T = 2 small.energy.
double energy_of_middle() {
  const double temperature = 2 * small.energy;
  const PhasePoint start = closed_chain_start(small.ring.chain(), {temperature, temperature}, false, key);
  double energy = 0.5 * start.scatterers[4] * start.scatterers[4];
  for (const Particle& particle : start.particles)
    if (std::floor(particle.position) == 4) energy += 0.5 * particle.velocity * particle.velocity;
  return energy;
}

// Detected mistakes: the pulse is in the neighbouring cell; the scatterer is not heated; the pulse energy is
// taken per cell instead of per degree of freedom.
TEST(PulseRun, RaisesTheEnergyOfTheMiddleToThatOfThePulse) {
  const PulseRun run(small, key, nothing);
  const std::vector<double> difference = run.energy_difference();
  ASSERT_EQ(difference.size(), 9U);
  EXPECT_NEAR(run.injected_energy() / (5 * small.pulse_energy - energy_of_middle()), 1, 1e-12);
  for (std::size_t cell = 0; cell < 9; ++cell) EXPECT_TRUE(cell == 4 || difference[cell] == 0) << cell;
  EXPECT_NEAR(sum(difference), run.injected_energy(), 1e-9);
}

// Detected mistakes: the energies with and without the pulse are added instead of subtracted; the magnitudes
// of the differences are summed.
TEST(PulseRun, ConservesTheEnergyOfThePulse) {
  PulseRun run(small, key, nothing);
  for (const double time : small.times) {
    run.run(time);
    std::vector<double> difference = run.energy_difference();
    EXPECT_LT(run.conservation_error(difference), 1e-13);
    EXPECT_LT(difference[4], 0.9 * run.injected_energy()) << "the pulse has spread";
    difference[2] += 0.01 * run.injected_energy();  // an energy error of 1 % must be reported
    EXPECT_GT(run.conservation_error(difference), 1e-3);
  }
  EXPECT_GT(run.events(), 10U);
}

// Both ways give equal energy differences. Detected mistake: the separate trajectories of a pair use
// different random numbers.
TEST(PulseRun, IsTheSameWithSeparateTrajectories) {
  for (const std::optional<double> gamma : {std::optional<double>{}, std::optional(2.)}) {
    PulseParameters parameters = small;
    parameters.ring.scattering.gamma = gamma;
    parameters.relaxation_time = 0.01;
    PulseRun together(parameters, key, nothing);
    PulseRun separate(parameters, key, nothing, false);
    together.run(0.02);
    separate.run(0.02);
    const std::vector<double> a = together.energy_difference(), b = separate.energy_difference();
    for (std::size_t cell = 0; cell < 9; ++cell)
      EXPECT_NEAR(a[cell], b[cell], 1e-9 * together.injected_energy()) << cell;
  }
}

TEST(PulseParameters, AreRefusedTogether) {
  EXPECT_NO_THROW(validate(PulseParameters{}));
  EXPECT_NO_THROW(validate(small));
  const auto refused = [](const std::string& beginning, const auto& change) {
    PulseParameters parameters = small;
    change(parameters);
    return refused_as(beginning, [&] { validate(parameters); });
  };
  EXPECT_TRUE(refused("--pulse-cells exceeds --cells", [](auto& p) { p.pulse_cells = 11; }));
  EXPECT_TRUE(refused("--pulse-cells is even", [](auto& p) { p.pulse_cells = 2; }));
  EXPECT_TRUE(refused("--cells is less than 7", [](auto& p) { p.ring.scattering.cells = 6; }));
  EXPECT_TRUE(refused("--times has one time", [](auto& p) { p.times = {1}; }));
  EXPECT_TRUE(refused("--cell-length, --relaxation-time, --times", [](auto& p) { p.times.back() = 1e12; }));
}

}  // namespace pulse_run_test
