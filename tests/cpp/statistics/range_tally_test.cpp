#include "statistics/range_tally.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace range_tally_test {

using namespace lorentz;

// Detected mistake: single elements are missing from the sums.
TEST(RangeTally, IsTheSumOverElements) {
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> uniform;
  RangeTally<2> tally(10);
  RangeTally<> spread(10);
  std::vector<double> plain(10, 0), overlap(10, 0);
  for (int trial = 0; trial < 500; ++trial) {
    const auto first = static_cast<std::ptrdiff_t>(10 * uniform(generator));
    const std::ptrdiff_t last = trial % 5 == 0 ? first : static_cast<std::ptrdiff_t>(10 * uniform(generator));
    const double value = uniform(generator);
    tally.add(first, last, {value, -2 * value});
    for (std::ptrdiff_t i = first; i <= last; ++i) plain[static_cast<std::size_t>(i)] += value;
    double low = 10 * uniform(generator), high = 10 * uniform(generator);
    if (trial % 3 == 0) low = std::floor(low), high = std::floor(high);
    if (low > high) std::swap(low, high);
    if (trial % 7 == 0) high = low;
    if (trial % 11 == 0) low = high = 10;
    spread.spread(low, high, {value});
    for (std::size_t i = 0; i < 10; ++i) {
      const double a = std::max(low, static_cast<double>(i)), b = std::min(high, static_cast<double>(i + 1));
      if (b > a) overlap[i] += value * (b - a) / (high - low);
    }
    if (low == high) overlap[std::min<std::size_t>(static_cast<std::size_t>(low), 9)] += value;
  }
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_NEAR(tally.sums(0)[i], plain[i], 1e-11);
    EXPECT_NEAR(tally.sums(1)[i], -2 * plain[i], 1e-11);
    EXPECT_NEAR(spread.sums()[i], overlap[i], 1e-11);
  }
}

}  // namespace range_tally_test
