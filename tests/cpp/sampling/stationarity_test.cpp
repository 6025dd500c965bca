#include "sampling/stationarity.hpp"

#include <gsl/gsl_cdf.h>
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

namespace stationarity_test {

using namespace lorentz;

/// The expected injections are 0, so that nothing is subtracted from the controls.
const OpenChain chain{{.cells = 5, .cell_length = 1. / 30}, {0, 1}, {0, 1}};
const Window window{2, 10};

// Detected mistakes: the middle scatterer is another one; the first half is not subtracted; the energy of a
// particle that leaves is added; exits after the window count.
TEST(WindowHalves, ChangesBetweenTheHalves) {
  const StationaryTallies all;
  const HalfDifferenceTallies& tallies = all.half_differences;
  WindowHalves halves(chain, window);
  halves.on_injection(End::left, 3, 2);
  halves.on_injection(End::left, 3, 0);
  halves.on_exit(End::right, 7, 4);
  halves.on_exit(End::left, 10, -8);
  for (const std::uint32_t scatterer : {0U, 1U, 2U, 3U, 4U})
    halves.on_scatterer(scatterer, 1. * scatterer, 6);
  halves.finish({0, 2, 4, 6, 8}, 10);
  TallySums sums(all);
  halves.record(all, sums);
  EXPECT_EQ(sums[tallies.energy_current], (0.25 * 16 - 0.25 * 4) / 4);
  EXPECT_EQ(sums[tallies.particle_current], -0.125);
  EXPECT_EQ(sums[tallies.energy], (2. - 8.) / 8);
  EXPECT_EQ(sums[tallies.particles], 1. / 8);
  const auto temperature = sums[tallies.temperature], injection = sums[tallies.injection];
  EXPECT_EQ(std::vector(temperature.begin(), temperature.end()), (std::vector<double>{0, 16 - 4, 64 - 16}));
  EXPECT_EQ(std::vector(injection.begin(), injection.end()), (std::vector<double>{-2, -2, -2, 0, 0, 0}));
}

// Detected mistakes: the energy is u^2 instead of u^2/2; the energy current has no sign; a crossing of one
// opening counts fully instead of half; exits are not counted, or outside the window, too; one half is left
// out.
TEST(WindowHalves, CurrentsAndInjectionsOfTheWindow) {
  const StationaryTallies tallies;
  WindowHalves halves(chain, window);
  halves.on_injection(End::left, 2.5, 2);
  halves.on_exit(End::right, 3.5, 3);
  halves.on_exit(End::left, 3.75, -1);
  halves.on_injection(End::right, 9.5, -4);
  for (const double outside : {1.9, 10.}) halves.on_exit(End::left, outside, -2);
  halves.finish({0, 0, 0, 0, 0}, 10);
  TallySums sums(tallies);
  halves.record(tallies, sums);
  EXPECT_EQ(halves.openings().energy, 1 + 2.25 - 0.25 - 4);
  EXPECT_EQ(halves.openings().particles, 0);
  const auto injection = sums[tallies.injection];
  EXPECT_EQ(std::vector(injection.begin(), injection.end()), (std::vector<double>{1, 2, 2, 1, 4, 8}));
}

// Detected mistakes: the momentum after the collision is used for the time before it; the middle scatterer is
// used in place of the last one; one half is left out.
TEST(WindowHalves, TemperaturesOfTheEnds) {
  WindowHalves halves(chain, window);
  halves.on_scatterer(0, 2, 4.5);
  halves.on_scatterer(2, 100, 5.5);
  halves.finish({4, 0, 100, 0, 3}, 10);
  EXPECT_EQ(halves.end_temperatures(), (std::array<double, 2>{(2.5 * 4 + 5.5 * 16) / 8, 9}));
}

/// stationarity_p_value of normal records of variance 1, with `shift` standard errors of the mean in one
/// column.
double p_value(std::size_t replicas, std::size_t shifted, double shift, std::uint64_t seed) {
  TallySchema schema;
  const HalfDifferenceTallies tallies(schema);
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  Records records(schema.width());
  for (std::size_t replica = 0; replica < replicas; ++replica) {
    std::vector<double> row(schema.width());
    for (double& value : row) value = normal(generator);
    row[shifted] += shift / std::sqrt(static_cast<double>(replicas));
    records.append(row);
  }
  return quantity_named(stationarity(tallies, chain).estimate(records), "stationarity_p_value").mean.front();
}

// The energy has half of the level, the other five columns the other half, which is exact for p << 1.
// Detected mistakes: one-sided p-values; no correction for the number of columns.
TEST(Stationarity, FalseAlarmsHaveTheStatedFrequency) {
  constexpr int runs = 20'000;
  int alarms = 0;
  for (std::uint64_t seed = 0; seed < runs; ++seed) alarms += p_value(16, 0, 0, seed) < 0.02 ? 1 : 0;
  EXPECT_NEAR(alarms, 0.02 * runs, 4 * std::sqrt(0.02 * runs));
}

// The p-value is twice the two-sided one of Student's t, exact for records whose mean and deviation are
// known. Detected mistakes: a one-sided or uncorrected p-value; degrees of freedom of as many as records.
TEST(Stationarity, ThresholdOfThePValue) {
  TallySchema schema;
  const HalfDifferenceTallies tallies(schema);
  Columns tested = tallies.halves();
  tested.push_back(tallies.energy.column);
  constexpr std::size_t replicas = 11;
  const OpenChain fed{{.cells = 5}, {6, 1}, {4, 1}};
  const double t = gsl_cdf_tdist_Qinv(1e-4 / 4, replicas - 1);
  for (const std::size_t column : tested)
    for (const double factor : {-1.01, -0.99, 0.99, 1.01}) {
      Records records(schema.width());
      for (std::size_t replica = 0; replica < replicas; ++replica) {
        std::vector<double> row(schema.width());
        const double noise = replica == 0 ? 0 : replica % 2 == 0 ? 1 : -1;  // of variance 1
        row[column] = factor * t / std::sqrt(replicas) + noise;
        records.append(row);
      }
      const Results found = stationarity(tallies, fed).estimate(records);
      EXPECT_EQ(quantity_named(found, "stationary").mean.front(), std::abs(factor) < 1) << column << factor;
    }
}

// Detected mistakes: the gain is compared with its error alone, so that the slow growth of every chain
// counts; with the number of particles in place of their share; a chain that loses particles passes; one
// passes whose gain could not be seen.
TEST(Stationarity, GainOfParticles) {
  TallySchema schema;
  const HalfDifferenceTallies tallies(schema);
  const auto stationary = [&](double gain, double scatter = 1e-3) {
    Records records(schema.width());
    for (const double noise : {-1., 1., -1., 1., -1., 1., -1., 1., -1., 1.}) {
      std::vector<double> row(schema.width(), noise);
      row[tallies.particles.column] = gain + scatter * noise;
      records.append(row);
    }
    const OpenChain fed{{.cells = 5}, {6, 1}, {4, 1}};
    return quantity_named(stationarity(tallies, fed).estimate(records), "stationary").mean.front();
  };
  for (const double sign : {-1., 1.}) {
    EXPECT_EQ(stationary(sign * 0.0405), 1) << sign;
    EXPECT_EQ(stationary(sign * 0.0415), 0) << sign;
    EXPECT_EQ(stationary(sign * 0.04, 0.1), 1) << sign;
    EXPECT_TRUE(std::isnan(stationary(sign * 0.04, 0.13))) << sign;
  }
}

// Detected mistake: the p-value of too few replicas is 1, so that they count as stationary.
TEST(Stationarity, FewReplicasAreNotTested) { EXPECT_TRUE(std::isnan(p_value(4, 0, 0, 1))); }

}  // namespace stationarity_test
