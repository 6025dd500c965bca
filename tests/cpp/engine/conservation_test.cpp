#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "engine/closed_dynamics.hpp"
#include "engine/closed_start.hpp"
#include "support/sample.hpp"

namespace conservation_test {

using namespace lorentz;

/// Changes of one invariant, collision by collision. In exact arithmetic each is 0, so each is the
/// rounding error of one collision.
class Steps {
 public:
  explicit Steps(std::size_t particles) : of_particle_(particles, 0) {}

  void add(std::size_t particle, long double change) {
    total_ += change;
    of_particle_[particle] += change;
  }

  /// The total over its standard error if the sums of different particles are independent random walks:
  /// between scatterers that hardly move, a particle's velocity and its rounding error repeat for thousands
  /// of collisions. Linear growth makes this score grow with the root of the number of events.
  double as_walks_of_particles() const {
    long double squares = 0;
    for (const long double sum : of_particle_) squares += sum * sum;
    return static_cast<double>(total_ / std::sqrt(squares));
  }

 private:
  long double total_ = 0;
  std::vector<long double> of_particle_;
};

/// Observer of both invariants. The differences are exact in extended precision up to its own roundings,
/// 2^-11 of those observed.
struct Invariances {
  Invariances(double sigma, std::size_t particles)
      : root_mass(Elastic(sigma).root_mass()), energy(particles), momentum(particles) {}

  void on_collision(const Collision& c) {
    const long double u = c.particle_before, u2 = c.particle_after;
    const long double scatterer = c.scatterer_before, scatterer2 = c.scatterer_after;
    energy.add(c.particle, ((u2 - u) * (u2 + u) + (scatterer2 - scatterer) * (scatterer2 + scatterer)) / 2);
    momentum.add(c.particle, u2 - u + root_mass * (scatterer2 - scatterer));
  }

  long double root_mass;
  Steps energy, momentum;
};

struct Outcome {
  double energy_drift = 0, momentum_drift = 0;  // relative changes of both invariants
  Invariances steps;
};

Outcome run(double sigma, std::uint64_t events, std::uint64_t seed) {
  const ClosedChain chain{11, 20, 1, sigma};
  ClosedDynamics dynamics(chain, closed_chain_start(chain, {}, false, {seed, 0}), 1e9, {1, 0});
  const Invariants before = dynamics.invariants();
  Invariances steps(sigma, chain.particles());
  for (double until = 0; dynamics.events() < events;) simulate(dynamics, until += 1, steps, [](double) {});
  const Invariants after = dynamics.invariants();
  return {(after.energy - before.energy) / before.energy,
          (after.momentum - before.momentum) / after.momentum_scale, steps};
}

constexpr std::uint64_t ten_million = 10'000'000;

// The hard cases are simple fractions (model/rules/elastic.hpp) and the limits.
TEST(Conservation, ErrorsStaySmallAndGrowAsTheRootOfTheNumberOfCollisions) {
  for (const double sigma : {-1 + 1e-12, -0.9, -0.5, 0.3, 1.0 / 3, 0.5, 0.6, 0.8, 0.9, 1 - 1e-12}) {
    const Outcome outcome = run(sigma, ten_million, 1);
    EXPECT_LT(std::abs(outcome.energy_drift), 1e-11) << sigma;
    EXPECT_LT(std::abs(outcome.momentum_drift), 1e-11) << sigma;
    EXPECT_LT(std::abs(outcome.steps.energy.as_walks_of_particles()), 4) << sigma;
    EXPECT_LT(std::abs(outcome.steps.momentum.as_walks_of_particles()), 4) << sigma;
  }
}

/// Mean relative energy gain of independent groups of encounters, in units of its standard error. A drift
/// that is too small to be visible in one group is found with many.
double mean_drift_score(const Elastic& law, int groups, std::uint64_t events) {
  std::vector<double> drifts;
  for (int group = 0; group < groups; ++group) {
    std::mt19937_64 generator(static_cast<std::uint64_t>(group));
    std::normal_distribution<double> velocity(0, 1);
    std::array<double, 220> particles{};
    std::array<double, 11> scatterers{};
    for (double& u : particles) u = velocity(generator);
    for (double& w : scatterers) w = velocity(generator) / law.scatterer_scale();
    const auto energy = [&] {
      long double twice_energy = 0;
      const long double mass = law.scatterer_scale() * law.scatterer_scale();
      for (const long double u : particles) twice_energy += u * u;
      for (const long double w : scatterers) twice_energy += mass * w * w;
      return twice_energy;
    };
    const long double before = energy();
    for (std::uint64_t event = 0; event < events; ++event) {
      const std::uint64_t draw = generator();
      law(particles[draw % particles.size()], scatterers[(draw >> 32) % scatterers.size()], 0);
    }
    drifts.push_back(static_cast<double>(energy() / before - 1));
  }
  return support::z_score(support::sample(drifts), 0);
}

TEST(Conservation, NothingIsLeftOfADriftThatABillionCollisionsWouldShow) {
  EXPECT_LT(std::abs(mean_drift_score(Elastic(0.5), 24, 5 * ten_million)), 4);
}

}  // namespace conservation_test
