#include "engine/scattering.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

namespace scattering_test {

using namespace lorentz;

constexpr double cell_length = 0.25;

ClosedChain ring(double gamma = std::numeric_limits<double>::infinity(), double sigma = 0.5) {
  ClosedChain chain;
  chain.cells = 7;
  chain.particles_per_cell = 3;
  chain.cell_length = cell_length;
  chain.sigma = sigma;
  chain.gamma = gamma;
  return chain;
}

/// What a flight and a scatterer become.
struct Scattered {
  Flight flight{};
  double w = 0;
  Departure departure{};
};

template <bool launching = false>
Scattered scattered(const ClosedChain& chain, Flight flight, double w) {
  const Departure departure =
      Scattering(chain).operator()<launching>(flight, w, FreeFlight(chain, {1, 0}, chain.particles()));
  return {flight, w, departure};
}

// Mutants: the flight's velocity or the scatterer's left as it was; the two exchanged.
TEST(Scattering, CollidesByTheRule) {
  for (const double sigma : {-1., -0.9, -0.3, 0., 0.5, 0.99, 1.}) {
    const ClosedChain chain = ring(std::numeric_limits<double>::infinity(), sigma);
    for (const double velocity : {-3., -1e-9, 0.7, 40.}) {
      double u = velocity, w = 1.25;
      CollisionRule{sigma}(u, w);
      const Scattered after = scattered(chain, {2, velocity, 3, 11}, 1.25);
      EXPECT_EQ(after.flight.velocity, u);
      EXPECT_EQ(after.departure.velocity, u);
      EXPECT_EQ(after.w, w);
    }
  }
}

// Mutant: the duration from the velocity before the collision.
TEST(Scattering, TheNextFlightGoesToTheNeighbourAhead) {
  const ClosedChain chain = ring();
  for (std::uint32_t cell = 0; cell < chain.cells; ++cell) {
    for (const double w : {-5., 5.}) {
      const Scattered after = scattered(chain, {2, 1, cell, 11}, w);
      const std::uint32_t ahead = (cell + (after.flight.velocity > 0 ? 1 : chain.cells - 1)) % chain.cells;
      EXPECT_EQ(after.flight.target, ahead);
      EXPECT_EQ(after.flight.particle, 11U);
      EXPECT_EQ(after.flight.draws, 0U);
      EXPECT_EQ(after.departure.time, 2);
      EXPECT_EQ(after.departure.cells, after.flight.velocity > 0 ? 1 : -1);
      EXPECT_EQ(after.departure.duration, cell_length / std::abs(after.flight.velocity));
      EXPECT_EQ(after.flight.time, 2 + after.departure.duration);
    }
  }
}

// Cells are those that FreeFlight draws, however often they lead around the ring. Mutants: a remainder that
// stays negative; the count of draws not handed on.
TEST(Scattering, FliesAsManyCellsAsAreDrawn) {
  const ClosedChain chain = ring(0.5);
  const FreeFlight launch(chain, {1, 0}, chain.particles());
  std::set<std::int64_t> rounds;
  for (std::uint64_t draws = 0; draws < 200; ++draws) {
    for (const double w : {-5., 5.}) {
      const Scattered after = scattered<true>(chain, {2, 1, 4, 11, draws}, w);
      std::uint64_t taken = draws;
      double u = after.flight.velocity;
      const std::int64_t cells = launch(11, taken, u);
      EXPECT_EQ(after.flight.draws, taken);
      EXPECT_EQ(after.departure.cells, u > 0 ? cells : -cells);
      EXPECT_EQ(after.departure.duration, static_cast<double>(cells) * cell_length / std::abs(u));
      const std::int64_t target = 4 + after.departure.cells, round = 70'000;
      EXPECT_EQ(after.flight.target, static_cast<std::uint32_t>((target + round) % 7));
      rounds.insert(target < 0 ? -1 : target / 7);
    }
  }
  EXPECT_TRUE(rounds.contains(-1));
  EXPECT_TRUE(rounds.contains(2));
}

// A particle that rests after a collision never arrives.
TEST(Scattering, AParticleAtRestNeverArrives) {
  const ClosedChain chain = ring(std::numeric_limits<double>::infinity(), 0);  // exchange of momenta
  const Scattered after = scattered(chain, {2, 1, 3, 11}, 0);
  EXPECT_EQ(after.flight.time, std::numeric_limits<double>::infinity());
  EXPECT_EQ(after.w, 1);
}

}  // namespace scattering_test
