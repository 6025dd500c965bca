#include "engine/injector.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/sample.hpp"

namespace injector_test {

using namespace lorentz;

constexpr Reservoir bath{220, 900. / 11};
constexpr double duration = 2, expected_count = 2 * 220;
constexpr std::uint64_t replicas = 400;

/// Sums of the injected quantities until `duration`, one value per replica.
struct Injections {
  std::vector<double> count, momentum, energy, fourth_power, slow;
};

Injections inject(const Reservoir& reservoir, std::uint64_t seed) {
  Injections all;
  for (std::uint64_t replica = 0; replica < replicas; ++replica) {
    Injector injector(reservoir, {seed, replica}, Purpose::injection_left);
    std::array<double, 5> sums{};
    while (injector.time() < duration && sums[0] < 10'000) {
      const double u = injector.take();
      EXPECT_GE(u, 0);
      sums[0] += 1;
      sums[1] += u;
      sums[2] += 0.5 * u * u;
      sums[3] += u * u * u * u;
      sums[4] += u < 3 ? 1 : 0;
    }
    all.count.push_back(sums[0]);
    all.momentum.push_back(sums[1]);
    all.energy.push_back(sums[2]);
    all.fourth_power.push_back(sums[3]);
    all.slow.push_back(sums[4]);
  }
  return all;
}

double z(const std::vector<double>& values, double exact) {
  return std::abs(support::z_score(support::sample(values), exact));
}

// Moments of the injected momenta [eqs. 5 and 6]. Detected mistakes: the injected energy is nu T per unit
// time, as the paper states; momenta have the distribution |p| exp(-p^2/2T) of the flux of a Maxwellian gas;
// the rate is 3 % too large.
TEST(Injector, MomentaAreHalfGaussian) {
  const Injections seen = inject(bath, 7);
  EXPECT_LT(z(seen.count, expected_count), 4);
  EXPECT_LT(z(seen.momentum, expected_count * bath.mean_momentum()), 4);
  EXPECT_LT(z(seen.energy, expected_count * bath.mean_energy()), 4);
  EXPECT_LT(z(seen.fourth_power, expected_count * 3 * bath.temperature * bath.temperature), 4);
  EXPECT_LT(z(seen.slow, expected_count * bath.probability(0, 3)), 4);

  EXPECT_GT(z(seen.energy, expected_count * bath.temperature), 4);
  EXPECT_GT(z(seen.momentum, expected_count * std::sqrt(std::numbers::pi * bath.temperature / 2)), 4);
  EXPECT_GT(z(inject({1.03 * bath.rate, bath.temperature}, 7).count, expected_count), 4);
}

// Intervals are exponential and independent of one another and of the momenta, so that counts are Poissonian.
TEST(Injector, IntervalsAreExponentialAndIndependent) {
  Injector injector(bath, {8, 0}, Purpose::injection_right);
  std::vector<double> interval, square, product_with_last, product_with_momentum;
  double before = 0, last = 0;
  for (int k = 0; k < 100'000; ++k) {
    const double scaled = bath.rate * (injector.time() - before);  // its mean is 1
    before = injector.time();
    const double momentum = injector.take() / bath.mean_momentum();
    interval.push_back(scaled);
    square.push_back(scaled * scaled);
    product_with_momentum.push_back((scaled - 1) * (momentum - 1));
    if (k > 0) product_with_last.push_back((scaled - 1) * (last - 1));
    last = scaled;
  }
  EXPECT_LT(z(interval, 1), 4);
  EXPECT_LT(z(square, 2), 4);
  EXPECT_LT(z(product_with_last, 0), 4);
  EXPECT_LT(z(product_with_momentum, 0), 4);
  EXPECT_GT(z(square, 2.1), 4);
}

}  // namespace injector_test
