#include "observables/correlation/ring_correlation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace ring_correlation_test {

using namespace lorentz;

/// Snapshot of a field without symmetry.
std::vector<double> snapshot(std::size_t cells, std::size_t j) {
  std::vector<double> field;
  for (std::size_t i = 0; i < cells; ++i)
    field.push_back(std::sin(1.3 * static_cast<double>(i * i + 5 * j)) +
                    0.2 * static_cast<double>(i % 3 == j % 3));
  return field;
}

/// Correlation by its definition: mean over cells, snapshots and both signs of r.
double direct(std::size_t cells, std::size_t snapshots, std::size_t lag, std::size_t r) {
  double sum = 0, count = 0;
  for (std::size_t j = 0; j + lag < snapshots; ++j) {
    const std::vector<double> before = snapshot(cells, j), after = snapshot(cells, j + lag);
    for (std::size_t i = 0; i < cells; ++i, ++count)
      sum += 0.5 * before[i] * (after[(i + r) % cells] + after[(i + cells - r) % cells]);
  }
  return sum / count;
}

// Detected mistakes: the last wave number of even rings is left out; lags are counted from the first
// snapshot; only one sign of r is included.
TEST(RingCorrelation, IsTheMeanOverCellsAndSnapshots) {
  const std::vector<std::size_t> lags{1, 2, 5};
  for (const std::size_t cells : {1UL, 2UL, 7UL, 8UL, 15UL, 22UL}) {
    RingCorrelation correlation(cells, lags);
    for (std::size_t j = 0; j < 9; ++j) correlation.add(snapshot(cells, j));
    for (std::size_t k = 0; k < lags.size(); ++k) {
      const std::vector<double> found = correlation.at(k);
      ASSERT_EQ(found.size(), cells);
      for (std::size_t r = 0; r < cells; ++r)
        EXPECT_NEAR(found[r], direct(cells, 9, lags[k], r), 1e-13) << cells << ' ' << lags[k] << ' ' << r;
    }
  }
}

}  // namespace ring_correlation_test
