#include "engine/pair.hpp"

#include <gtest/gtest.h>

#include "engine/closed_dynamics.hpp"
#include "engine/closed_start.hpp"
#include "support/collisions.hpp"

namespace {

using namespace lorentz;

void expect_same(const PhasePoint& a, const PhasePoint& b) {
  ASSERT_EQ(a.scatterers, b.scatterers);
  ASSERT_EQ(a.particles.size(), b.particles.size());
  for (std::size_t i = 0; i < a.particles.size(); ++i) {
    ASSERT_EQ(a.particles[i].position, b.particles[i].position) << i;
    ASSERT_EQ(a.particles[i].velocity, b.particles[i].velocity) << i;
  }
}

PhasePoint kicked(PhasePoint point) {
  for (std::size_t i = 200; i < 220; ++i) point.particles[i].velocity *= 3;
  point.scatterers[10] *= 3;
  return point;
}

class Pair : public testing::TestWithParam<ClosedChain> {};

TEST_P(Pair, IsTwoSimulationsBitForBit) {
  const ClosedChain chain = GetParam();
  const PhasePoint start = closed_chain_start(chain, {500, 500}, false, {1, 0});
  constexpr double end = 1;
  ClosedDynamics plain(chain, start, end, {5, 7}), perturbed(chain, kicked(start), end, {5, 7});
  PairDynamics pair(chain, start, kicked(start), end, {5, 7});
  NoObserver nobody;
  for (const double time : {0.01, 0.1, 0.3, 1.0}) {
    simulate(plain, time, nobody, support::nothing);
    simulate(perturbed, time, nobody, support::nothing);
    pair.run(time, support::nothing);
    const auto [first, second] = pair.phase_points(time);
    expect_same(first, plain.phase_point(time));
    expect_same(second, perturbed.phase_point(time));
  }
  EXPECT_EQ(pair.events(), plain.events() + perturbed.events());
}

TEST_P(Pair, SharesWhatIsTheSame) {
  const ClosedChain chain = GetParam();
  const PhasePoint start = closed_chain_start(chain, {500, 500}, false, {1, 0});
  PairDynamics pair(chain, start, kicked(start), 0.2, {5, 7});
  pair.run(0.2, support::nothing);
  EXPECT_LT(pair.computed(), pair.events());
  PairDynamics equal(chain, start, start, 0.2, {5, 7});
  equal.run(0.2, support::nothing);
  EXPECT_EQ(2 * equal.computed(), equal.events());
  PairDynamics separate(chain, start, kicked(start), 0.2, {5, 7}, false);
  separate.run(0.2, support::nothing);
  EXPECT_EQ(separate.computed(), separate.events());
  expect_same(separate.phase_points(0.2)[1], pair.phase_points(0.2)[1]);
}

INSTANTIATE_TEST_SUITE_P(Chains, Pair,
                         testing::Values(ClosedChain{21, 20, 1, 0.5}, ClosedChain{21, 20, 0.5, -0.9},
                                         ClosedChain{21, 20, 1, 0.5, 1.0}, ClosedChain{21, 20, 1, 0, 3.0}));

}  // namespace
