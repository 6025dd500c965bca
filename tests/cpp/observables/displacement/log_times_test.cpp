#include "observables/displacement/log_times.hpp"

#include <gtest/gtest.h>

namespace log_times_test {

using namespace lorentz;

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
