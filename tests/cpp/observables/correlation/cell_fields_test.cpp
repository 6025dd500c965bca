#include "observables/correlation/cell_fields.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "model/rules/elastic.hpp"
#include "reference/heap_simulator.hpp"
#include "sampling/closed_run.hpp"
#include "support/sample.hpp"

namespace {

using namespace lorentz;

// Momentum and energy of every cell equal those of the reference simulator at several times. Detected
// mistake: a cell is centred at a scatterer instead of extending from one scatterer to the next.
TEST(CellFields, AreThoseOfTheReference) {
  for (const double sigma : {-0.6, 0.0, 0.5, 0.9}) {
    ClosedParameters parameters;
    parameters.ring = {.scattering = {.cells = 9, .sigma = sigma}, .cell_length = 0.7};
    parameters.temperature = 1.5;
    parameters.fugacity = 2;
    parameters.relaxation_time = 0;
    parameters.observation_time = 6;
    const ClosedChain chain = parameters.chain();
    const Replica replica{{5, 2}, [](double) {}};
    ClosedRun run(parameters, replica);
    const PhasePoint start = run.chain().phase_point(0);
    const Elastic rule(sigma);
    auto reference = reference::heap_simulator<long double>(rule.sigma(), chain.cell_length, start);
    reference::HeapSimulator<long double>::Event event{};
    CellFields particles(start, chain);
    double difference = 0, of_mutant = 0;
    for (const double time : {0.0, 0.4, 1.7, 6.0}) {
      run.observe(particles, time);
      while (reference.step(time, event)) {
      }
      const auto totals = reference.totals(time, 0.5), around = reference.totals(time);
      const std::vector<double> scatterers = run.chain().scatterers();
      for (std::size_t cell = 0; cell < chain.cells; ++cell) {
        const double U = scatterers[cell], momentum = particles.momenta()[cell] + rule.root_mass() * U;
        const double energy = particles.energies()[cell] + 0.5 * U * U;
        difference += std::abs(momentum - static_cast<double>(totals.momentum[cell])) +
                      std::abs(energy - static_cast<double>(totals.energy[cell]));
        of_mutant += std::abs(momentum - static_cast<double>(around.momentum[cell]));
      }
    }
    EXPECT_LT(difference, 1e-9) << sigma;
    EXPECT_GT(of_mutant, 1) << sigma;
  }
}

/// Means over the cells of products of the fields of a cell in the stationary initial state, one value per
/// replica.
struct Moments {
  std::vector<double> momentum, heat, with_energy, neighbours;
};

Moments moments(double zeta, double theta, double temperature) {
  const ClosedChain chain{.cells = 400, .sigma = 0.5};
  const StationaryMeasure measure{.fugacity = zeta, .temperature = temperature, .slowest = 1e-3};
  const double root_mass = Elastic(chain.sigma).root_mass(), cells = chain.cells;
  Moments found;
  for (std::uint64_t replica = 0; replica < 100; ++replica) {
    const PhasePoint start = stationary_start(chain, measure, {3, replica});
    const CellFields particles(start, chain);
    double momentum = 0, heat = 0, with_energy = 0, neighbours = 0, before = 0;
    for (std::size_t cell = 0; cell < chain.cells; ++cell) {
      const double U = start.scatterers[cell], g = particles.momenta()[cell] + root_mass * U;
      const double of_particles = particles.energies()[cell], h = 0.5 * U * U - theta * of_particles;
      momentum += g * g / cells;
      heat += h * h / cells;
      with_energy += h * (0.5 * U * U + of_particles - temperature * (0.5 + zeta)) / cells;
      neighbours += g * before / cells;
      before = g;
    }
    found.momentum.push_back(momentum);
    found.heat.push_back(heat);
    found.with_energy.push_back(with_energy);
    found.neighbours.push_back(neighbours);
  }
  return found;
}

// In the stationary state the momentum g has the variance T (2 zeta + M). The heat field E_s - E_p/(2 zeta)
// has the variance T^2/2 + T^2/(4 zeta) and is uncorrelated with the energy (docs/mode_coupling.md). Cells
// are independent. The effect of the cut at small momenta is below the statistical error. Detected mistakes:
// another fugacity; another factor theta of E_p.
TEST(CellFields, OfTheStartHaveTheExactMoments) {
  const double zeta = 1.6, T = 2.5, M = 3;
  const auto z = [](const std::vector<double>& values, double exact) {
    return std::abs(support::z_score(support::sample(values), exact));
  };
  const double of_momentum = T * (2 * zeta + M), of_heat = T * T * (0.5 + 0.25 / zeta);
  const Moments found = moments(zeta, 0.5 / zeta, T);
  EXPECT_LT(z(found.momentum, of_momentum), 4);
  EXPECT_LT(z(found.heat, of_heat), 4);
  EXPECT_LT(z(found.with_energy, 0), 4);
  EXPECT_LT(z(found.neighbours, 0), 4);
  const Moments denser = moments(1.1 * zeta, 0.5 / zeta, T);
  EXPECT_GT(z(denser.momentum, of_momentum), 4);
  EXPECT_GT(z(denser.with_energy, 0), 4);
  EXPECT_GT(z(moments(zeta, 0.6 / zeta, T).with_energy, 0), 4);
}

}  // namespace
