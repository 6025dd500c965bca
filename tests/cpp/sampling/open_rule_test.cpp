/// Open chains of every collision rule against the reference simulator, which shares neither code nor random
/// numbers with the engine.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "observables/steady_profile/cell_profile.hpp"
#include "reference/open_heap_simulator.hpp"
#include "sampling/open_run.hpp"
#include "support/sample.hpp"

namespace open_rule_test {

using namespace lorentz;

constexpr std::size_t cells = 4;
constexpr std::uint64_t replicas = 300;
const Window window{2, 12};

/// Values of all replicas by quantity: temperatures of the scatterers, then currents through the bonds.
using Values = std::vector<std::vector<double>>;

OpenParameters parameters(const RuleParameters& rule, std::optional<double> gamma) {
  return {.scattering = {.cells = cells, .sigma = 0.3, .gamma = gamma, .rule = rule},
          .left = {20, 50},
          .right = {10, 200},
          .start = "empty"};
}

Values measured(const OpenParameters& chain) {
  const Bins bins(2, 1);
  const CellTallies tallies(cells, bins);
  Values values(cells + 2 * (cells + 1));
  for (std::uint64_t index = 0; index < replicas; ++index) {
    const Replica replica{{5, index}, [](double) {}};
    OpenRun run(chain, window, replica);
    CellProfile profile(chain.chain(), window, bins);
    run.observe(profile);
    TallySums sums(tallies);
    profile.record(tallies, sums);
    std::size_t k = 0;
    for (const double temperature : sums[tallies.temperature]) values[k++].push_back(temperature);
    for (const Tally tally : {tallies.crossings, tallies.crossing_squares})
      for (std::size_t bond = 0; bond <= cells; ++bond)
        values[k++].push_back(sums[tally.row(rightwards)][bond] - sums[tally.row(leftwards)][bond]);
  }
  return values;
}

Values of_reference(double particle_reversal, double scatterer_reversal, double gamma) {
  Values values(cells + 2 * (cells + 1));
  for (std::uint64_t index = 0; index < replicas; ++index) {
    reference::OpenHeapSimulator simulator(
        {cells, 0.25, 0.3, gamma, 20, 10, 50, 200, window.begin, window.end - window.begin, 2, 1}, index);
    simulator.reverse(particle_reversal, scatterer_reversal, 1000 + index);
    simulator.run(window.end);
    std::size_t k = 0;
    for (std::size_t cell = 0; cell < cells; ++cell) values[k++].push_back(simulator.temperature(cell));
    for (std::size_t bond = 0; bond <= cells; ++bond) values[k++].push_back(simulator.particle_current(bond));
    for (std::size_t bond = 0; bond <= cells; ++bond)
      values[k++].push_back(2 * simulator.energy_current(bond));
  }
  return values;
}

double largest_score(const Values& a, const Values& b) {
  double largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    largest = std::max(largest, std::abs(support::z_score(support::sample(a[k]), support::sample(b[k]))));
  return largest;
}

// Detected mistakes: another collision rule; another gamma; one drawn direction for all collisions of a cell.
TEST(OpenRule, HasTheTemperaturesAndCurrentsOfTheReference) {
  const RuleParameters elastic, random{"random-direction"},
      reversal{"reversal", {{"--reversal-probability", 0.3}}};
  for (const std::optional<double> gamma : {std::optional<double>{}, std::optional(2.)}) {
    const double mean = gamma.value_or(cells);
    const Values kept = of_reference(0, 0, mean), drawn = of_reference(0.5, 0, mean),
                 reversed = of_reference(0, 0.3, mean);
    EXPECT_LT(largest_score(measured(parameters(elastic, gamma)), kept), 4);
    EXPECT_LT(largest_score(measured(parameters(random, gamma)), drawn), 4);
    EXPECT_LT(largest_score(measured(parameters(reversal, gamma)), reversed), 4);
    EXPECT_GT(largest_score(kept, drawn), 6);
    EXPECT_GT(largest_score(kept, reversed), 6);
    EXPECT_GT(largest_score(of_reference(0, 0.1, mean), reversed), 6);
    EXPECT_GT(largest_score(measured(parameters(random, 3)), drawn), 6);
  }
}

}  // namespace open_rule_test
