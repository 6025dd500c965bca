#include "observables/conductivity/blocking.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace blocking_test {

using namespace lorentz;

/// Block means of a first-order autoregressive process of variance 1. correlation: that of neighbouring
/// steps.
Records process(double correlation, std::size_t replicas, std::size_t blocks, std::size_t steps,
                unsigned seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  Records records(blocks);
  for (std::size_t replica = 0; replica < replicas; ++replica) {
    double x = normal(generator);
    std::vector<double> means(blocks, 0);
    for (double& mean : means) {
      for (std::size_t i = 0; i < steps; ++i) {
        x = correlation * x + std::sqrt(1 - correlation * correlation) * normal(generator);
        mean += x / static_cast<double>(steps);
      }
    }
    records.append(means);
  }
  return records;
}

TEST(Blocking, OfIndependentNumbersIsFlatAndExact) {
  const Blocking result = blocking(process(0, 500, 8, 1, 1));
  ASSERT_EQ(result.error.size(), 4U);
  for (std::size_t level = 0; level < 4; ++level)
    EXPECT_LT(std::abs(result.error[level] - 1 / std::sqrt(4000.)), 4 * result.uncertainty[level]);
  EXPECT_TRUE(result.converged());
}

TEST(Blocking, RisesToTheErrorOfACorrelatedProcess) {
  // The exact variance of the mean of many steps is (1 + rho)/(1 - rho)/steps = 19/steps.
  const Blocking result = blocking(process(0.9, 400, 8, 400, 2));
  const double exact = std::sqrt(19. / (400 * 8 * 400));
  EXPECT_LT(std::abs(result.error.back() - exact), 4 * result.uncertainty.back());
  EXPECT_TRUE(result.converged());
}

TEST(Blocking, FindsBlocksThatAreTooShort) {
  const Blocking result = blocking(process(0.98, 400, 8, 2, 3));
  EXPECT_GT(result.error.back(), 2 * result.error.front());
  EXPECT_FALSE(result.converged());
}

// The sum of the blocks telescopes, so that the error of n joined blocks is 1/n of that of one, not
// 1/sqrt(n).
TEST(Blocking, AcceptsAnErrorThatFalls) {
  std::mt19937_64 generator(4);
  std::normal_distribution<double> normal;
  Records records(8);
  for (int replica = 0; replica < 100; ++replica) {
    std::vector<double> differences(8);
    double before = normal(generator);
    for (double& difference : differences) {
      const double now = normal(generator);
      difference = now - std::exchange(before, now);
    }
    records.append(differences);
  }
  const Blocking result = blocking(records);
  EXPECT_LT(result.error.back(), 0.5 * result.error.front());
  EXPECT_TRUE(result.converged());
}

/// A process with sufficiently long blocks is seldom reported as not converged.
TEST(Blocking, SeldomRaisesAFalseAlarm) {
  int alarms = 0;
  for (unsigned seed = 0; seed < 400; ++seed)
    alarms += blocking(process(0.5, 24, 8, 100, seed)).converged() ? 0 : 1;
  EXPECT_LT(alarms, 12);
}

}  // namespace blocking_test
