#include "observables/heat_current/heat_current.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "model/rules/elastic.hpp"
#include "reference/heap_simulator.hpp"

namespace heat_current_test {

using namespace lorentz;

constexpr double temperature = 1.5, end_time = 6;
constexpr std::size_t count = 4;

/// Integrated current by the reference simulator, to which every flight adds its overlap with a block.
/// overlap: false selects a mutant that counts a flight in the block in which it ends.
std::vector<double> by_flights(const ClosedParameters& parameters, const Blocks& blocks, const StreamKey& key,
                               bool overlap) {
  const ClosedChain chain = parameters.chain();
  const PhasePoint start = stationary_start(chain, parameters.stationary_measure(), key);
  const double sigma = Elastic(chain.sigma).sigma();
  auto simulator = reference::heap_simulator<long double>(sigma, chain.cell_length, start);
  std::vector<double> sums(count, 0);
  const auto fly = [&](double v, double begin, double end) {
    for (std::size_t b = 0; b < count; ++b) {
      const double inside = std::min(end, blocks.edge(b + 1)) - std::max(begin, blocks.edge(b));
      const bool ends = end > blocks.edge(b) && end <= blocks.edge(b + 1);
      const double duration = overlap ? std::max(0.0, inside) : ends ? end - begin : 0;
      sums[b] += v * (v * v / 2 - temperature) * duration;
    }
  };
  std::vector<double> since(start.particles.size(), 0), v;
  for (const Particle& particle : start.particles) v.push_back(particle.velocity);
  reference::HeapSimulator<long double>::Event event{};
  while (simulator.step(end_time, event)) {
    const std::size_t i = event.particle;
    const auto time = static_cast<double>(event.time);
    fly(v[i], since[i], time);
    since[i] = time;
    v[i] = static_cast<double>(event.p_after);
  }
  for (std::size_t i = 0; i < v.size(); ++i) fly(v[i], since[i], end_time);
  return sums;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

// The current agrees in every block, not only on average. The last block ends before the run does.
TEST(HeatCurrent, IsThatOfTheReferenceInEveryBlock) {
  for (const double sigma : {-0.6, 0.0, 0.5, 0.9}) {
    ClosedParameters parameters;
    parameters.ring = {.scattering = {.cells = 9, .sigma = sigma}, .cell_length = 0.7};
    parameters.temperature = temperature;
    parameters.fugacity = 2;
    parameters.relaxation_time = 0;
    parameters.observation_time = end_time;
    const Blocks blocks(0, 0.9 * end_time, count);
    const Replica replica{{5, 2}, [](double) {}};
    ClosedRun run(parameters, replica);
    HeatCurrent current(run, parameters.ring, temperature, blocks);
    run.observe(current);
    current.finish();
    const std::vector<double> flights = by_flights(parameters, blocks, replica.key, true);
    EXPECT_LT(largest_difference(current.integrals(), flights), 1e-9) << sigma;
    const std::vector<double> mutant = by_flights(parameters, blocks, replica.key, false);
    EXPECT_GT(largest_difference(current.integrals(), mutant), 1e-3) << sigma;
  }
}

// Energy that a collision gives to the scatterer to the right has moved by one cell to the right.
TEST(HeatCurrent, CountsTheEnergyThatIsCarriedToANeighbour) {
  ClosedParameters parameters;
  parameters.ring = {.scattering = {.cells = 9, .sigma = 0.5}, .cell_length = 0.7};
  parameters.fugacity = 2;
  parameters.relaxation_time = 0;
  const Replica replica{{5, 2}, [](double) {}};
  const ClosedRun run(parameters, replica);
  const auto heat = [&](int neighbour) {
    HeatCurrent current(run, parameters.ring, temperature, Blocks(0, 1, 1));
    const double u = 2, u_after = -1, U = 1, U_after = 0.5;  // an energy of 15/8 is carried
    current.on_collision({0.25, 0, 3, u, u_after, U, U_after, neighbour});
    current.finish();
    return current.integrals().front();
  };
  EXPECT_NEAR(heat(1) - heat(0), 0.7 * 15 / 8, 1e-12);
  EXPECT_NEAR(heat(-1) - heat(0), -0.7 * 15 / 8, 1e-12);
}

}  // namespace heat_current_test
