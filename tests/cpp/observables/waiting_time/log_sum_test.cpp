#include "observables/waiting_time/log_sum.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "numerics/random.hpp"

namespace log_sum_test {

using namespace lorentz;

// Detected mistakes: when the product leaves the range of a double, it is not reset to 1, or its logarithm is
// not added.
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
    // Bound on the sum of the rounding errors of all additions.
    EXPECT_NEAR(sum.sum(), static_cast<double>(exact), static_cast<double>(1e4L * 0x1p-53L * magnitude))
        << scale;
  }
  EXPECT_EQ(LogSum().sum(), 0);
}

}  // namespace log_sum_test
