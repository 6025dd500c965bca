#include "statistics/log_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace log_grid_test {

using namespace lorentz;

TEST(LogGrid, HasPointsAndMiddlesAtEqualFactors) {
  const LogGrid grid(0.01, 3, 8);
  ASSERT_EQ(grid.points().size(), 25U);
  for (std::size_t i = 0; i < 25; ++i)
    EXPECT_NEAR(grid.points()[i], 0.01 * std::pow(10, 0.125 * static_cast<double>(i)), 1e-12);
  EXPECT_NEAR(grid.middles()[23], 0.01 * std::pow(10, 0.125 * 23.5), 1e-12);
}

// A point belongs exactly to the interval above it. Detected mistakes: cells of the look-up table are twice
// as wide, so that some contain two points; a point counts in the interval below it.
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

}  // namespace log_grid_test
