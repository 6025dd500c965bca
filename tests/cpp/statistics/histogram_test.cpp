#include "statistics/histogram.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace histogram_test {

using namespace lorentz;

/// The double that is `steps` representable numbers above x.
double neighbour(double x, int steps) {
  for (; steps > 0; --steps) x = std::nextafter(x, 1e300);
  for (; steps < 0; ++steps) x = std::nextafter(x, -1e300);
  return x;
}

// In steps of one double the bin number never decreases. It changes within two units in the last place of
// every edge, and both halves are mirror images. Detected mistake: half the number of bins is added before
// truncation, which rounds -1e-17 to 0.
TEST(Bins, ChangeAtTheEdges) {
  for (const double max : {3., 60., 0.7, 1e-150, 1e150}) {
    const Bins bins(100, max);
    for (std::size_t edge = 1; edge < 100; ++edge) {
      std::size_t before = edge - 1;
      for (int steps = -3; steps <= 3; ++steps) {
        const double value = neighbour(bins.edge(edge), steps);
        const std::size_t bin = bins[value];
        ASSERT_TRUE(bin == before || bin == edge) << max << " " << edge << " " << steps;
        before = bin;
        if (value != 0) {
          ASSERT_EQ(bins[-value], 99 - bin);
        }
      }
      ASSERT_EQ(bins[neighbour(bins.edge(edge), -3)], edge - 1);
      ASSERT_EQ(before, edge);
    }
    EXPECT_EQ(bins[-1e-17 * max], 49U);
    EXPECT_EQ(bins[neighbour(max, -3)], 99U);
    EXPECT_EQ(bins[neighbour(max, 3)], 100U);
  }
}

// Detected mistakes: values outside the range count in the last bin, or not in the total; weights are
// replaced by 1.
TEST(Histogram, SumsWeightsInTheBinsAndInAll) {
  Histogram histogram(Bins(4, 2));
  for (const double value : {-2.5, -1.5, -0.5, 0.5, 0.5, 2., 7.}) histogram.add(value);
  histogram.add(1.5, 0.25);
  histogram.add(-0.5, -3);
  EXPECT_EQ(histogram.weights(), (std::vector<double>{1, -2, 2, 0.25}));
}

}  // namespace histogram_test
