#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "numerics/random.hpp"
#include "statistics/moving_peak.hpp"
#include "support/sample.hpp"

namespace collapse_test {

using namespace lorentz;

/// Profiles y = t^-xi f(x/t^xi) of an asymmetric function f, with Gaussian noise.
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

}  // namespace collapse_test
