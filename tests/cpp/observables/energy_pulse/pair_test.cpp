#include "observables/energy_pulse/pair.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "engine/closed_dynamics.hpp"
#include "engine/closed_start.hpp"
#include "support/collisions.hpp"

namespace pair_test {

using namespace lorentz;

void expect_same(const Particle& a, const Particle& b, std::uint32_t number) {
  EXPECT_EQ(a.position, b.position) << number;
  EXPECT_EQ(a.velocity, b.velocity) << number;
}

/// Expects the diverged particles and scatterers of the pair to equal those of the two simulations, and all
/// others to be equal in both simulations. Returns the number of diverged particles.
std::ptrdiff_t expect_pair(const PairDynamics& pair, double time, const PhasePoint& plain,
                           const PhasePoint& perturbed) {
  std::vector<char> particle_diverged(plain.particles.size()), scatterer_diverged(plain.scatterers.size());
  pair.for_each_diverged_particle(time,
                                  [&](std::uint32_t number, const Particle& one, const Particle& other) {
                                    EXPECT_FALSE(std::exchange(particle_diverged[number], true));
                                    expect_same(one, plain.particles[number], number);
                                    expect_same(other, perturbed.particles[number], number);
                                  });
  pair.for_each_diverged_scatterer([&](std::uint32_t cell, double one, double other) {
    EXPECT_FALSE(std::exchange(scatterer_diverged[cell], true));
    EXPECT_EQ(one, plain.scatterers[cell]);
    EXPECT_EQ(other, perturbed.scatterers[cell]);
  });
  for (std::uint32_t i = 0; i < particle_diverged.size(); ++i)
    if (!particle_diverged[i]) expect_same(plain.particles[i], perturbed.particles[i], i);
  for (std::uint32_t i = 0; i < scatterer_diverged.size(); ++i)
    if (!scatterer_diverged[i]) {
      EXPECT_EQ(plain.scatterers[i], perturbed.scatterers[i]) << i;
    }
  return std::ranges::count(particle_diverged, true);
}

/// A state at which particles have taken random numbers before.
PhasePoint start_of(const ClosedChain& chain) {
  PhasePoint point = closed_chain_start(chain, {500, 500}, false, {1, 0});
  for (Particle& particle : point.particles) particle.draws = 5;
  return point;
}

PhasePoint kicked(PhasePoint point) {
  for (std::size_t i = 200; i < 220; ++i) point.particles[i].velocity *= 3;
  point.scatterers[10] *= 3;
  return point;
}

class Pair : public testing::TestWithParam<ClosedChain> {};

// What is the same in both trajectories is shared, unless the pair must not.
TEST_P(Pair, IsTwoSimulationsBitForBit) {
  const ClosedChain chain = GetParam();
  const PhasePoint start = start_of(chain);
  constexpr double end = 1;
  for (const bool share : {true, false}) {
    ClosedDynamics plain(chain, start, end, {5, 7}), perturbed(chain, kicked(start), end, {5, 7});
    PairDynamics pair(chain, start, kicked(start), end, {5, 7}, share);
    NoObserver nobody;
    for (const double time : {0.01, 0.1, 0.3, 1.0}) {
      simulate(plain, time, nobody, support::nothing);
      simulate(perturbed, time, nobody, support::nothing);
      pair.run(time, support::nothing);
      const std::ptrdiff_t diverged =
          expect_pair(pair, time, plain.phase_point(time), perturbed.phase_point(time));
      if (time == 0.01 || !share) {
        EXPECT_EQ(diverged < chain.particles(), share);
      }
    }
    EXPECT_EQ(pair.events(), plain.events() + perturbed.events());
  }
}

INSTANTIATE_TEST_SUITE_P(Chains, Pair,
                         testing::Values(ClosedChain{{.cells = 21}},
                                         ClosedChain{{.cells = 21, .cell_length = 0.5, .sigma = -0.9}},
                                         ClosedChain{{.cells = 21, .gamma = 1}},
                                         ClosedChain{{.cells = 21, .sigma = 0, .gamma = 3}},
                                         ClosedChain{{.cells = 21, .rule = {"random-direction"}}},
                                         ClosedChain{{.cells = 21, .gamma = 3, .rule = {"random-direction"}}},
                                         ClosedChain{{.cells = 21, .rule = {"reversal", {0.3}}}}));

}  // namespace pair_test
