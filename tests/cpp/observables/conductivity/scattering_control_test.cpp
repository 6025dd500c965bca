#include "observables/conductivity/scattering_control.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "engine/path.hpp"
#include "statistics/time_integral.hpp"
#include "support/sample.hpp"

namespace scattering_control_test {

using namespace lorentz;

struct Watched {
  double control;  // variate
  double energy;   // mean U^2
};

struct Arrival {
  double time, u;
  bool scattered;
};

/// A scatterer under a Poisson process of arriving particles. u is normal, and one arrival in eight scatters.
/// Each arrival is registered at the time of the one before it. assumed_sigma: sigma in the control variate.
/// late: a mutant that uses the momentum after a collision instead of that before.
Watched watch(double sigma, double assumed_sigma, bool late, std::mt19937_64& generator) {
  const double c = std::sqrt(1 - sigma * sigma);
  const Window window(10, 60);
  ScatteringControl control({.cells = 8, .sigma = assumed_sigma, .gamma = 1});
  TimeIntegral energy(Blocks(10, 60, 1));
  std::exponential_distribution<double> interval(10);
  std::normal_distribution<double> normal;
  std::bernoulli_distribution scatters(1. / 8);
  const auto after = [&](double time) {
    const Arrival next{time + interval(generator), normal(generator), scatters(generator)};
    if (window.contains(next.time)) control.arrival(next.time, next.u, next.scattered);
    return next;
  };
  double momentum = 3;  // far from equilibrium
  for (Arrival arrival = after(0); arrival.time < 70;) {
    const Arrival now = arrival;
    arrival = after(now.time);
    if (!now.scattered) continue;
    const double before = momentum;
    momentum = c * now.u + sigma * before;
    energy.advance(before * before, now.time);
    control.advance(late ? momentum : before, now.time);
  }
  return {control.sum(), energy.sums()[0] / 50};
}

struct Found {
  double score;      // z-score of the control's mean
  double explained;  // part of the variance of the mean energy
};

Found found(double sigma, double assumed_sigma, bool late) {
  constexpr int samples = 4000;
  std::mt19937_64 generator(1);
  std::vector<double> controls, energies;
  for (int i = 0; i < samples; ++i) {
    const Watched watched = watch(sigma, assumed_sigma, late, generator);
    controls.push_back(watched.control);
    energies.push_back(watched.energy);
  }
  const support::Sample control = support::sample(controls), energy = support::sample(energies);
  double covariance = 0;  // covariance of the two means
  for (std::size_t i = 0; i < controls.size(); ++i)
    covariance += (controls[i] - control.mean) * (energies[i] - energy.mean) / (samples * (samples - 1.));
  const double correlation = covariance / (control.standard_error * energy.standard_error);
  return {support::z_score(control, 0.0), correlation * correlation};
}

// Detected mistakes: the momentum after the collision is used, which depends on the collision and gives a
// nonzero mean; sigma has the wrong sign, which only reduces the explained variance.
TEST(ScatteringControl, HasMeanZeroAndExplainsTheNoise) {
  for (const double sigma : {0.5, -0.3, 0.9}) {
    const Found right = found(sigma, sigma, false), late = found(sigma, sigma, true),
                reversed = found(sigma, -sigma, false);
    EXPECT_LT(std::abs(right.score), 4) << sigma;
    EXPECT_LT(std::abs(reversed.score), 4) << sigma;
    EXPECT_GT(std::abs(late.score), 10) << sigma;
    EXPECT_GT(right.explained, 0.75) << sigma;
    EXPECT_LT(reversed.explained, 0.75) << sigma;
  }
}

}  // namespace scattering_control_test
