#include "observables/correlation/cell_fields.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "model/rules/elastic.hpp"
#include "reference/heap_simulator.hpp"
#include "sampling/closed_run.hpp"

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

}  // namespace
