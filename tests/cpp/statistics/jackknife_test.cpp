#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "statistics/group.hpp"
#include "support/sample.hpp"

namespace jackknife_test {

using namespace lorentz;

std::vector<double> identity(std::span<const double> mean) { return {mean.begin(), mean.end()}; }
std::vector<double> ratio(std::span<const double> mean) { return {mean[1] / mean[0]}; }

Estimates jackknife_of(const Records& records, std::vector<double> (*f)(std::span<const double>)) {
  return jackknife(records, [&](TallyMeans mean) { return f(mean[Tally{0, records.width()}]); });
}

// For the mean, the leave-one-out values are the mean plus (mean - x_r)/(R-1), and the jackknife error is the
// usual standard error.
TEST(Jackknife, IsTheStandardErrorOfAMean) {
  std::mt19937_64 generator(1);
  std::normal_distribution<double> normal(1000, 1);
  for (const int replicas : {2, 3, 10, 1000}) {
    Records records(1);
    for (int i = 0; i < replicas; ++i) records.append(std::vector{normal(generator)});
    const Estimates estimate = jackknife_of(records, identity);
    const support::Sample expected = support::sample(records.values());
    // The mean has rounding errors of 2^-53 of 1000, which multiplies in x_r.
    EXPECT_NEAR(estimate.mean[0], expected.mean, 1e-12);
    EXPECT_NEAR(estimate.standard_error[0] / expected.standard_error, 1, 1e-12 * replicas);
  }
}

// Rare events, such as the longest waiting times, occur in one replica only. Their part of the mean is not a
// binary fraction, so that mean + (mean - x)/(R-1) would leave rounding errors, whose ratio is arbitrary.
TEST(Jackknife, IsNaNWhereOnlyOneReplicaHasARatio) {
  for (const int replicas : {3, 7, 24, 49}) {
    Records records(2);
    for (int i = 1; i < replicas; ++i) records.append(std::vector{0.0, 0.0});
    records.append(std::vector{3.0, 0.7});
    const Estimates estimate = jackknife_of(records, ratio);
    EXPECT_NEAR(estimate.mean[0], 0.7 / 3, 1e-15);
    EXPECT_TRUE(std::isnan(estimate.standard_error[0])) << replicas;
  }
}

TEST(Jackknife, IsExactlyZeroWithoutSpread) {
  for (const double value : {0.1, 1e-300, 1e300, -7.3}) {
    Records records(1);
    for (int i = 0; i < 7; ++i) records.append(std::vector{value});
    EXPECT_EQ(jackknife_of(records, identity).mean, std::vector{value});
    EXPECT_EQ(jackknife_of(records, identity).standard_error, std::vector{0.0});
  }
}

}  // namespace jackknife_test
