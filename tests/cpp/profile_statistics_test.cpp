#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/random.hpp"
#include "statistics/collapse.hpp"
#include "statistics/fit.hpp"
#include "statistics/log_grid.hpp"
#include "support/sample.hpp"

namespace {

using namespace lorentz;

TEST(Fit, FindsExactLinesAndPowers) {
  const std::vector<double> x = {1, 2, 4, 5, 7};
  std::vector<double> line, power;
  for (const double value : x) {
    line.push_back(3 - 2 * value);
    power.push_back(5 * std::pow(value, -2.0 / 3));
  }
  EXPECT_NEAR(fit_line(x, line).slope, -2, 1e-13);
  EXPECT_NEAR(fit_line(x, line).intercept, 3, 1e-13);
  EXPECT_NEAR(fit_power(x, power, 1, 7), -2.0 / 3, 1e-13);
  EXPECT_NEAR(fit_power(x, power, 2, 5), -2.0 / 3, 1e-13);
}

TEST(Fit, RefusesTooFewPoints) {
  const std::vector<double> one = {1}, two = {1, 2};
  EXPECT_THROW(fit_line(one, one), std::invalid_argument);
  EXPECT_THROW(fit_power(two, two, 5, 6), std::invalid_argument);
}

TEST(LogGrid, HasEqualFactorsAndFindsIntervals) {
  const LogGrid grid(0.01, 3, 8);
  const std::vector<double> points = grid.points();
  ASSERT_EQ(points.size(), 25U);
  EXPECT_NEAR(points.front(), 0.01, 1e-16);
  EXPECT_NEAR(points.back(), 10, 1e-13);
  for (std::size_t i = 0; i < grid.intervals(); ++i) {
    EXPECT_NEAR(points[i + 1] / points[i], std::pow(10, 0.125), 1e-12);
    EXPECT_EQ(grid.interval(std::log(grid.middles()[i])), i);
  }
  EXPECT_EQ(grid.interval(-100), 0U);
  EXPECT_EQ(grid.interval(100), grid.intervals() - 1);
}

/// Profiles y = t^-xi f(x/t^xi) of a lopsided f, with Gaussian noise.
std::vector<Profile> scaling_profiles(double xi, double noise, std::uint64_t seed) {
  RandomStream random({seed, 0}, Purpose::initial_position, 0);
  std::vector<Profile> profiles;
  for (const double time : {1.0, 2.0, 4.0, 8.0}) {
    Profile profile{time, {}, {}};
    for (int cell = -60; cell <= 60; ++cell) {
      const double s = cell / std::pow(time, xi) / 6;
      profile.x.push_back(cell);
      profile.y.push_back(std::exp(-s * s + 0.3 * s) / std::pow(time, xi) + noise * random.gaussian());
    }
    profiles.push_back(profile);
  }
  return profiles;
}

TEST(Collapse, FindsTheExponent) {
  for (const double xi : {0.5, 0.6, 2.0 / 3, 1.0})
    EXPECT_NEAR(collapse_exponent(scaling_profiles(xi, 0, 1), -15, 15), xi, 0.01);
}

TEST(Collapse, IsUnbiasedUnderNoise) {
  std::vector<double> found;
  for (std::uint64_t seed = 0; seed < 100; ++seed)
    found.push_back(collapse_exponent(scaling_profiles(0.6, 0.01, seed), -15, 15));
  const double exact = collapse_exponent(scaling_profiles(0.6, 0, 1), -15, 15);
  EXPECT_LT(std::abs(support::z_score(support::sample(found), exact)), 4);
  EXPECT_GT(std::abs(support::z_score(support::sample(found), exact + 0.01)), 4);
}

}  // namespace
