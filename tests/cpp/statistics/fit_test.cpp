#include "statistics/fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace fit_test {

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

// For points that are not on a line the slope is cov(x, y)/var(x). Detected mistake: the line through the
// first and the last point.
TEST(Fit, WeighsAllPointsEqually) {
  const std::vector<double> x = {0, 1, 2, 3}, y = {0, 2, 1, 1};
  const Line line = fit_line(x, y);
  EXPECT_NEAR(line.slope, 0.2, 1e-15);
  EXPECT_NEAR(line.intercept, 0.7, 1e-15);
}

// The range of the fit includes both of its ends and nothing beyond. Detected mistakes: an end is excluded;
// all points are used.
TEST(Fit, PowersUseTheirRangeOnly) {
  const std::vector<double> x = {1, 2, 4, 8}, y = {1000, 1, 16, 0};
  EXPECT_NEAR(fit_power(x, y, 2, 4), 4, 1e-13);
}

TEST(Fit, RefusesTooFewPoints) {
  const std::vector<double> one = {1}, two = {1, 2};
  EXPECT_THROW(fit_line(one, one), std::invalid_argument);
  EXPECT_THROW(fit_power(two, two, 5, 6), std::invalid_argument);
}

}  // namespace fit_test
