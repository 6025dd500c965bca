#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/closed_dynamics.hpp"
#include "engine/closed_start.hpp"
#include "reference/heap_simulator.hpp"
#include "support/collisions.hpp"

namespace clock_test {

using namespace lorentz;

constexpr std::size_t events = 4000;
constexpr double cell_length = 1, temperature = 500;

/// For each scatterer the sequence of arriving particles, which alone determines the velocities.
using Arrivals = std::vector<std::vector<std::size_t>>;

ClosedChain chain(double sigma) { return {{11, cell_length, sigma}, 20}; }

PhasePoint start(double sigma) { return closed_chain_start(chain(sigma), {temperature, 100}, false, {1, 0}); }

/// Arrivals in a chain whose clock begins at `flights` thermal flights and is restarted `restarts` times.
Arrivals arrivals(double sigma, double flights, int restarts = 0) {
  const double shown = flights * cell_length / std::sqrt(temperature);
  ClosedDynamics dynamics(chain(sigma), start(sigma), 1e6, {1, 0});
  support::Recorder engine;
  dynamics.restart_clock(-shown);
  double until = shown;
  for (; restarts > 0; --restarts) {
    dynamics.restart_clock(until);
    simulate(dynamics, until = 0.25, engine, support::nothing);
  }
  while (engine.collisions.size() < events) simulate(dynamics, until += 0.25, engine, support::nothing);
  Arrivals result(11);
  for (std::size_t k = 0; k < events; ++k)
    result[engine.collisions[k].scatterer].push_back(engine.collisions[k].particle);
  return result;
}

Arrivals in_extended_precision(double sigma) {
  auto simulator = reference::heap_simulator<long double>(Elastic(sigma).sigma(), cell_length, start(sigma));
  Arrivals result(11);
  reference::HeapSimulator<long double>::Event event{};
  for (std::size_t k = 0; k < events && simulator.step(1e9L, event); ++k)
    result[event.scatterer].push_back(event.particle);
  return result;
}

/// Whether all common elements of the lists are equal. The last event of a list may have no counterpart.
bool same_order(const Arrivals& a, const Arrivals& b) {
  for (std::size_t cell = 0; cell < a.size(); ++cell) {
    const auto common = static_cast<std::ptrdiff_t>(std::min(a[cell].size(), b[cell].size()));
    if (!std::equal(a[cell].begin(), a[cell].begin() + common, b[cell].begin())) return false;
  }
  return true;
}

// Programs restart the clock of a closed chain every 2^32 thermal flights. Detected mistakes: the clock runs
// for 2^40 flights, where the order of events is wrong; a restart changes the order.
TEST(Clock, KeepsTheOrderOfEventsAsLongAsItRuns) {
  for (const double sigma : {-0.9, 0.0, 0.5}) {
    const Arrivals exact = in_extended_precision(sigma);
    EXPECT_TRUE(same_order(arrivals(sigma, 0x1p32), exact)) << sigma;
    EXPECT_FALSE(same_order(arrivals(sigma, 0x1p40), exact)) << sigma;
    EXPECT_TRUE(same_order(arrivals(sigma, 0x1p32, 10), exact)) << sigma;
  }
}

}  // namespace clock_test
