#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "engine/closed_dynamics.hpp"
#include "engine/closed_start.hpp"
#include "support/collisions.hpp"

namespace frozen_particles_test {

using namespace lorentz;
using namespace support;

/// All numbers of a collision.
auto numbers(const Collision& one) {
  return std::tuple(one.time, one.particle, one.scatterer, one.particle_before, one.particle_after,
                    one.scatterer_before, one.scatterer_after);
}

// A particle that never arrives has no effect: the chain without it has the same collisions.
TEST(FrozenParticles, TouchNothing) {
  const ClosedChain few{{.cells = 4}, 2};
  const ClosedChain more{{.cells = 4}, 3};
  const PhasePoint start = closed_chain_start(few, {}, false, {3, 0});
  const std::vector<Collision> expected = collisions(few, start, 50);
  ASSERT_GT(expected.size(), 1000U);
  for (const double velocity : {0.0, -0.0, 5e-324, -5e-324, 1e-310, -1e-308}) {
    PhasePoint crowded = start;
    for (const double position : {0.5, 0.0, 3.999, 2.5}) crowded.particles.push_back({position, velocity});
    EXPECT_TRUE(std::ranges::equal(collisions(more, crowded, 50), expected, {}, numbers, numbers));
    ClosedDynamics dynamics(more, crowded, 50, {1, 0});
    NoObserver nobody;
    simulate(dynamics, 50, nobody, nothing);
    const Invariants invariants = dynamics.invariants();
    EXPECT_TRUE(std::isfinite(invariants.energy) && std::isfinite(invariants.momentum) &&
                std::isfinite(invariants.momentum_scale));
  }
}

// At sigma = 0 a particle takes over the velocity of the scatterer. The first particle to reach a scatterer
// at rest thus stops there for ever, so one particle per scatterer stops.
TEST(FrozenParticles, AreThoseThatStop) {
  const ClosedChain chain{{.cells = 11, .sigma = 0}, 20};
  const PhasePoint start = closed_chain_start(chain, {}, false, {4, 0});
  const std::vector<Collision> all = collisions(chain, start, 20);
  std::vector<bool> stopped(chain.particles(), false);
  for (const Collision& collision : all) {
    ASSERT_FALSE(stopped[collision.particle]);
    if (collision.particle_after == 0) stopped[collision.particle] = true;
  }
  EXPECT_EQ(std::count(stopped.begin(), stopped.end(), true), chain.cells);

  // Stopped particles keep their positions. Detected mistake: the flight and position() use different
  // directions for u = 0.
  ClosedDynamics dynamics(chain, start, 20, {1, 0});
  NoObserver nobody;
  simulate(dynamics, 20, nobody, nothing);
  const PhasePoint end = dynamics.phase_point(20);
  for (const Collision& collision : all) {
    if (collision.particle_after == 0) {
      EXPECT_DOUBLE_EQ(end.particles[collision.particle].position, collision.scatterer + 0.5);
    }
  }
}

}  // namespace frozen_particles_test
