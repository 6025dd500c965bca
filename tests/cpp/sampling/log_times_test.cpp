#include "sampling/log_times.hpp"

#include <gtest/gtest.h>

namespace log_times_test {

using namespace lorentz;

// Detected mistake: the last time is not set to the observation time, from which the grid differs by rounding
// for some of these values.
TEST(LogTimes, EndWithTheObservation) {
  for (const double last : {0.3, 1., 7., 1e3, 12345.678, 1e6}) {
    const std::vector<double> times = LogTimeParameters{.decades = 3}.times(last);
    ASSERT_EQ(times.size(), 25U);
    EXPECT_EQ(times.back(), last);
    EXPECT_NEAR(times.front() / last, 1e-3, 1e-15);
    EXPECT_NEAR(times[16] / last, 0.1, 1e-13);  // the grid has eight times per decade
  }
}

// Detected mistakes: without the factor 1 - 1e-9 rounding excludes the first point for some values; `decades`
// is used in place of `fit_decades`.
TEST(LogTimes, FitBeginsWithAPointOfTheGrid) {
  const LogTimeParameters parameters{.decades = 6, .fit_decades = 2};
  for (double last = 0.01; last < 1e6; last *= 1.37) {
    const std::vector<double> times = parameters.times(last);
    EXPECT_GE(times[times.size() - 17], parameters.fit_from(last)) << last;
    EXPECT_LT(times[times.size() - 18], parameters.fit_from(last)) << last;
  }
}

}  // namespace log_times_test
