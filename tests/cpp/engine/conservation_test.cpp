#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "model/rules/elastic.hpp"
#include "support/sample.hpp"

namespace conservation_test {

using namespace lorentz;

struct Drift {
  double energy, momentum;
};

/// Relative changes of energy and momentum in random encounters of 220 particles with 11 scatterers.
Drift drift(const Elastic& law, std::uint64_t events, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> velocity(0, 1);
  std::array<double, 220> particles{};
  std::array<double, 11> scatterers{};
  for (double& u : particles) u = velocity(generator);
  for (double& w : scatterers) w = velocity(generator) / law.scatterer_scale();
  const auto sums = [&] {
    const long double scale = law.scatterer_scale(), root_mass = law.root_mass();
    std::array<long double, 3> all{};  // twice the energy, the momentum and its scale
    const auto add = [&](long double u, long double root) {
      all[0] += u * u;
      all[1] += root * u;
      all[2] += root * std::abs(u);
    };
    for (const double each : particles) add(each, 1);
    for (const double each : scatterers) add(scale * each, root_mass);
    return all;
  };
  const auto before = sums();
  for (std::uint64_t event = 0; event < events; ++event) {
    const std::uint64_t draw = generator();
    law(particles[draw % particles.size()], scatterers[(draw >> 32) % scatterers.size()], 0);
  }
  const auto after = sums();
  return {static_cast<double>(after[0] / before[0] - 1),
          static_cast<double>((after[1] - before[1]) / after[2])};
}

/// Expects that the mean drifts of independent groups are 0 within four standard errors. A drift that is too
/// small to be visible in one group is found with many.
void expect_no_drift(double sigma, std::uint64_t events) {
  std::vector<double> energy, momentum;
  for (std::uint64_t group = 0; group < 24; ++group) {
    const Drift found = drift(Elastic(sigma), events, group);
    energy.push_back(found.energy);
    momentum.push_back(found.momentum);
  }
  for (const std::vector<double>& drifts : {energy, momentum}) {
    EXPECT_LT(std::abs(support::z_score(support::sample(drifts), 0)), 4) << sigma;
    for (const double each : drifts) EXPECT_LT(std::abs(each), 1e-12) << sigma;
  }
}

// The hard cases are simple fractions (model/rules/elastic.hpp) and the limits. Detected mistakes: the energy
// of a collision changes by the rounding error of a coefficient; rounding errors have a mean.
TEST(Conservation, ErrorsAreRandomWalks) {
  for (const double sigma : {-1 + 1e-12, -0.9, -0.5, 0.3, 1.0 / 3, 0.6, 0.8, 0.9, 1 - 1e-12})
    expect_no_drift(sigma, 2'000'000);
}

TEST(Conservation, NothingIsLeftOfADriftThatABillionCollisionsWouldShow) { expect_no_drift(0.5, 50'000'000); }

}  // namespace conservation_test
