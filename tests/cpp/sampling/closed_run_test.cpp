#include "sampling/closed_run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/sample.hpp"

namespace closed_run_test {

using namespace lorentz;

const Replica replica{{1, 0}, [](double) {}};

struct Counter {
  std::uint64_t collisions = 0;
  double first = -1, last = -1;
  void on_collision(const Collision& collision) {
    if (++collisions == 1) first = collision.time;
    last = collision.time;
  }
};

struct Errors {
  std::uint64_t events;
  double energy, momentum;
};

Errors finished(const ClosedRun& run) {
  const ClosedTallies tallies;
  TallySums sums(tallies);
  const std::uint64_t events = run.finish(tallies, sums);
  return {events, sums[tallies.energy_change], sums[tallies.momentum_change]};
}

// The particles are too slow to reach a scatterer, so that nothing happens and nothing drifts. The clock
// restarts every 2^32 thermal flights of the scatterers, here 232 times. Detected mistakes: the clock is not
// restarted; clock_start_ is not moved.
TEST(ClosedRun, WithoutScatterings) {
  const ClosedParameters parameters{
      .temperature = 1e-50, .scatterer_temperature = 1, .relaxation_time = 5e11, .observation_time = 5e11};
  ClosedRun run(parameters, replica);
  run.relax();
  Counter counter;
  run.observe(counter);
  EXPECT_EQ(counter.collisions, 0U);
  const double shown = run.clock(parameters.end_time());
  EXPECT_GT(shown, 0);
  EXPECT_LE(shown, 0x1p32);
  EXPECT_EQ(std::fmod(parameters.end_time() - shown, 0x1p32), 0);
  const Errors errors = finished(run);
  EXPECT_EQ(errors.events, 0U);
  EXPECT_EQ(errors.energy, 0);
  EXPECT_EQ(errors.momentum, 0);
}

// Detected mistakes: the relaxation is observed; errors are relative to an initial energy or momentum of 0,
// which makes them 1 and 0.02; only events after the relaxation are counted.
TEST(ClosedRun, ObservesAfterTheRelaxationAndConserves) {
  for (const double sigma : {-0.7, 0., 0.5, 0.9}) {
    const ClosedParameters parameters{
        .ring = {.scattering = {.cells = 5, .sigma = sigma}}, .relaxation_time = 2, .observation_time = 3};
    ClosedRun run(parameters, replica);
    run.relax();
    const std::uint64_t before = finished(run).events;
    Counter counter;
    run.observe(counter);
    const Errors errors = finished(run);
    EXPECT_GT(before, 1000U);
    EXPECT_GE(counter.first, 2);
    EXPECT_LT(counter.last, 5);
    EXPECT_EQ(errors.events, before + counter.collisions);
    EXPECT_LT(errors.energy, 1e-12);
    EXPECT_LT(errors.momentum, 1e-12);
  }
}

// Over replicas the controls have the mean 0; their variances are those of the square of a normal number and
// of a sum of 9 such squares. Detected mistakes: the subtracted mean is that of the particles alone, which is
// far off for M = 19; the momentum is not squared.
TEST(ClosedRun, ControlHasMeanZero) {
  const ClosedParameters parameters{
      .ring = {.scattering = {.cells = 3, .sigma = 0.9}, .particles_per_cell = 2},
      .temperature = 2,
      .scatterer_temperature = 5,
  };
  std::vector<double> momenta;
  for (std::uint64_t index = 0; index < 2000; ++index) {
    const Replica one{{7, index}, [](double) {}};
    const ClosedRun run(parameters, one);
    momenta.push_back(run.momentum_control());
  }
  EXPECT_LT(std::abs(support::z_score(support::sample(momenta), 0)), 4);
  EXPECT_NEAR(support::sample(momenta).standard_error * std::sqrt(2000), std::sqrt(2), 0.2);
}

}  // namespace closed_run_test
