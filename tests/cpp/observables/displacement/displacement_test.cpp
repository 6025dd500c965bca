#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/closed_dynamics.hpp"
#include "engine/closed_start.hpp"
#include "reference/heap_simulator.hpp"
#include "support/collisions.hpp"
#include "support/sample.hpp"

namespace displacement_test {

using namespace lorentz;

constexpr double end_time = 5;
constexpr std::uint64_t replicas = 100;
const ClosedChain chain{11, 20, 1, 0.5};

PhasePoint start(std::uint64_t seed, std::uint64_t replica) {
  return closed_chain_start(chain, {500, 500}, false, {seed, replica});
}

struct Walk {
  std::vector<std::int64_t> cells;
  void on_flight(const Departure& departure) { cells[departure.particle] += departure.cells; }
};

/// Mean square displacement of all particles during `end_time`, one value per replica, calculated as in the
/// program displacement.
std::vector<double> engine() {
  std::vector<double> values;
  for (std::uint64_t replica = 0; replica < replicas; ++replica) {
    ClosedDynamics dynamics(chain, start(1, replica), end_time, {1, replica});
    const std::vector<double> before = dynamics.positions_from_targets(0);
    Walk walk{std::vector<std::int64_t>(before.size(), 0)};
    simulate(dynamics, end_time, walk, support::nothing);
    const std::vector<double> after = dynamics.positions_from_targets(end_time);
    double sum = 0;
    for (std::uint32_t i = 0; i < chain.particles(); ++i) {
      const double x = static_cast<double>(walk.cells[i]) + after[i] - before[i];
      sum += x * x;
    }
    values.push_back(sum / chain.particles());
  }
  return values;
}

/// Mean square displacement by the reference simulator, which adds up the unwrapped path over events.
/// unsigned_flights: a mutant that counts every flight as one to the right.
std::vector<double> reference_simulator(bool unsigned_flights = false) {
  std::vector<double> values;
  for (std::uint64_t replica = 0; replica < replicas; ++replica) {
    const PhasePoint begin = start(2, replica);
    auto simulator = reference::heap_simulator<double>(chain.sigma, 1, begin);
    std::vector<double> position(begin.particles.size(), 0), since(begin.particles.size(), 0), p;
    for (const Particle& particle : begin.particles) p.push_back(particle.velocity);
    reference::HeapSimulator<double>::Event event{};
    while (simulator.step(end_time, event)) {
      position[event.particle] += p[event.particle] * (event.time - since[event.particle]);
      since[event.particle] = event.time;
      p[event.particle] = unsigned_flights ? std::abs(event.p_after) : event.p_after;
    }
    double sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const double x = position[i] + p[i] * (end_time - since[i]);
      sum += x * x;
    }
    values.push_back(sum / static_cast<double>(p.size()));
  }
  return values;
}

TEST(Displacement, AgreesWithTheReference) {
  const support::Sample ours = support::sample(engine());
  EXPECT_LT(std::abs(support::z_score(ours, support::sample(reference_simulator()))), 4);
  EXPECT_GT(std::abs(support::z_score(ours, support::sample(reference_simulator(true)))), 10);
}

}  // namespace displacement_test
