#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "engine/random.hpp"
#include "statistics/collapse.hpp"
#include "statistics/fit.hpp"
#include "statistics/log_grid.hpp"
#include "statistics/log_sum.hpp"
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
    EXPECT_EQ(grid.interval(grid.middles()[i]), i);
  }
}

// Exactly: a point belongs to the interval above it. Mutants: cells of the table twice as wide, which hold
// two points; a point counted to the interval below.
TEST(LogGrid, FindsIntervalsNextToPointsAndBeyondTheEnds) {
  for (const std::size_t per_decade : {1, 8, 10, 37}) {
    for (const double first : {0.01, 3., 1e-200, 1e200}) {
      const LogGrid grid(first, 3, per_decade);
      const std::vector<double> points = grid.points();
      for (std::size_t i = 1; i < grid.intervals(); ++i) {
        ASSERT_EQ(grid.interval(std::nextafter(points[i], 0.)), i - 1) << per_decade << " " << first;
        ASSERT_EQ(grid.interval(points[i]), i) << per_decade << " " << first;
      }
      for (const double below : {5e-324, 1e-300, points[0] / 2, std::nextafter(points[0], 0.), points[0]})
        EXPECT_EQ(grid.interval(below), 0U) << per_decade << " " << first;
      for (const double above : {std::nextafter(points.back(), 0.), points.back(), 2 * points.back(), 1e308,
                                 std::numeric_limits<double>::infinity()})
        EXPECT_EQ(grid.interval(above), grid.intervals() - 1) << per_decade << " " << first;
    }
  }
}

// Mutant: the product not set back to 1, or its own logarithm forgotten, when it leaves the range.
TEST(LogSum, IsTheSumOfLogarithms) {
  RandomStream random({1, 0}, Purpose::initial_position, 0);
  for (const double scale : {1e-300, 1e-3, 1., 50., 1e300}) {
    LogSum sum;
    long double exact = 0, magnitude = 0;
    for (int i = 0; i < 10'000; ++i) {
      const double number = scale * std::exp(5 * random.gaussian());
      sum.add(number);
      exact += std::log(static_cast<long double>(number));
      magnitude += std::abs(std::log(static_cast<long double>(number)));
    }
    // What rounding every one of as many additions may amount to.
    EXPECT_NEAR(sum.sum(), static_cast<double>(exact), static_cast<double>(1e4L * 0x1p-53L * magnitude))
        << scale;
  }
  EXPECT_EQ(LogSum().sum(), 0);
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
