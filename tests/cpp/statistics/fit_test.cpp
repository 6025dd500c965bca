#include "statistics/fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace fit_test {

using namespace lorentz;

// For points that are not on a line the slope is cov(x, y)/var(x). Detected mistakes: the line through the
// first and the last point; weights are ignored, or squared.
TEST(Fit, IsTheLineOfLeastSquares) {
  const std::vector<double> x = {0, 1, 2, 3}, y = {0, 2, 1, 1};
  const Line equal = fit_line(x, y);
  EXPECT_NEAR(equal.slope, 0.2, 1e-15);
  EXPECT_NEAR(equal.intercept, 0.7, 1e-15);
  const Line weighted = fit_line(x, y, std::vector<double>{1, 2, 1, 0});
  EXPECT_NEAR(weighted.slope, 0.5, 1e-15);
  EXPECT_NEAR(weighted.intercept, 0.75, 1e-15);
}

// The range of the fit includes both of its ends and nothing beyond. Detected mistakes: an end is excluded;
// all points are used.
TEST(Fit, UsesThePointsInItsRange) {
  const std::vector<double> x = {1, 2, 4, 8}, y = {1000, 1, 16, 0};
  EXPECT_NEAR(fit_power(x, y, 2, 4), 4, 1e-13);
  EXPECT_NEAR(fit_logarithm(x, y, 2, 4), 15 / std::log(2), 1e-13);
}

TEST(Fit, FindsPowersOfLogarithms) {
  const std::vector<double> x = {1, 20, 300, 4000};
  std::vector<double> y;
  for (const double value : x) y.push_back(7 * value * std::pow(std::abs(std::log(value / 2)), 1.5));
  EXPECT_NEAR(fit_logarithmic_power(x, y, 20, 2), 1.5, 1e-13);
  EXPECT_TRUE(std::isnan(fit_logarithmic_power(x, y, 1, 2)));
}

TEST(Fit, FindsLocalExponentsOfPositiveValues) {
  const std::vector<double> found =
      local_exponents(std::vector<double>{1, 2, 4, 8}, std::vector<double>{3, 12, 6, 0});
  EXPECT_NEAR(found[0], 2, 1e-15);
  EXPECT_NEAR(found[1], -1, 1e-15);
  EXPECT_TRUE(std::isnan(found[2]));
}

TEST(Fit, RefusesTooFewPoints) {
  const std::vector<double> one = {1}, two = {1, 2};
  EXPECT_THROW(fit_line(one, one), std::invalid_argument);
  EXPECT_THROW(fit_power(two, two, 5, 6), std::invalid_argument);
}

}  // namespace fit_test
