/// Which random numbers starts, injections and flights take: no two replicas, seeds or sources share one.
/// tests/cpp/numerics/random_test.cpp tests the words of a stream.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "engine/closed_dynamics.hpp"
#include "engine/closed_start.hpp"
#include "engine/open_dynamics.hpp"
#include "engine/open_start.hpp"
#include "engine/stationary_start.hpp"
#include "support/collisions.hpp"

namespace chance_test {

using namespace lorentz;

struct Injections {
  std::vector<double> drawn;
  void on_injection(End, double time, double u) { drawn.insert(drawn.end(), {time, std::abs(u)}); }
};

/// Continuous numbers that initial states and injections reveal, at T = 1. stationary: of the start of a
/// closed chain; both starts of it have the same streams.
std::vector<double> draws(const StreamKey& key, bool stationary) {
  std::vector<double> drawn;
  const auto add = [&](const PhasePoint& point) {
    for (const double U : point.scatterers) drawn.push_back(std::abs(U));
    for (const auto& [x, u, _] : point.particles) drawn.insert(drawn.end(), {x - std::floor(x), std::abs(u)});
  };
  const ClosedChain ring{{.cells = 100}, 10};
  const OpenChain row{{.cells = 100}, {5, 1}, {5, 1}};
  add(stationary ? stationary_start(ring, {1, 1, 0.01}, key) : closed_chain_start(ring, {1, 1}, false, key));
  add(local_equilibrium_start(row, row.left, row.right, 10, key));
  OpenDynamics dynamics(row, empty_start(row), 100, key);
  Injections seen;
  simulate(dynamics, 100, seen, support::nothing);
  drawn.insert(drawn.end(), seen.drawn.begin(), seen.drawn.end());
  return drawn;
}

bool all_differ(const std::vector<StreamKey>& keys, bool stationary) {
  std::vector<double> all;
  for (const StreamKey& key : keys) std::ranges::copy(draws(key, stationary), std::back_inserter(all));
  EXPECT_GT(all.size(), 5000 * keys.size());
  std::ranges::sort(all);
  return std::ranges::adjacent_find(all) == all.end();
}

TEST(Chance, ReplicasSeedsAndSourcesShareNoNumber) {
  for (const bool stationary : {false, true}) {
    EXPECT_TRUE(all_differ({{1, 0}, {1, 1}, {2, 0}}, stationary));
    EXPECT_FALSE(all_differ({{1, 0}, {1, 0}}, stationary));
  }
}

/// Observer that compares every flight with the numbers of its particle, counted from those in `start` on.
/// The first flight, which is not reported, takes one.
struct FlightsOfParticles {
  const StreamKey& key;
  GeometricCells cells;
  std::vector<Particle> particles;
  std::size_t flights = 0, wrong = 0;

  void on_flight(const Departure& flight) {
    const std::uint64_t draw = ++particles[flight.particle].draws;
    const auto uniform = [&](Purpose purpose) {
      return RandomStream(key, purpose, flight.particle, draw).uniform();
    };
    const std::int64_t expected = cells(uniform(Purpose::passes));
    const bool right = uniform(Purpose::collision) > 0.5;
    wrong += flight.cells == (right ? expected : -expected) ? 0 : 1;
    ++flights;
  }
};

// The numbers of a flight in a closed chain are named by the particle and its count, also if the chain
// continues from a later state. Detected mistake: the count begins again.
TEST(Chance, FlightsOfAClosedChainHaveNumbersOfTheirOwn) {
  const StreamKey key(3, 2);
  for (const double gamma : {16, 64}) {
    const ClosedChain chain{{.cells = 64, .gamma = gamma, .rule = {"random-direction"}}, 1};
    const PhasePoint begin = closed_chain_start(chain, {1, 1}, false, key);
    PhasePoint end;
    const auto wrong = [&](const PhasePoint& start, const std::vector<Particle>& counted) {
      ClosedDynamics dynamics(chain, start, 400, key);
      FlightsOfParticles flights{key, GeometricCells(gamma / 64), counted};
      simulate(dynamics, 400, flights, support::nothing);
      EXPECT_GT(flights.flights, 1000U);
      end = dynamics.phase_point(400);
      return flights.wrong;
    };
    EXPECT_EQ(wrong(begin, begin.particles), 0U);
    const PhasePoint later = end;
    EXPECT_EQ(wrong(later, later.particles), 0U);
    EXPECT_GT(wrong(later, begin.particles), 500U);
  }
}

}  // namespace chance_test
