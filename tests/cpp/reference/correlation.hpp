#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <random>
#include <vector>

#include "reference/arguments.hpp"
#include "reference/heap_simulator.hpp"

namespace reference {

struct Fields {
  std::vector<double> momentum, heat;
};

inline Fields fields(const HeapSimulator<double>& chain, double time, double zeta) {
  HeapSimulator<double>::Totals totals = chain.totals(time, 0.5);
  Fields found{totals.momentum, {}};
  for (std::size_t i = 0; i < totals.energy.size(); ++i) {
    const double P = chain.scatterers()[i], of_scatterer = P * P / (2 * chain.scatterer_mass());
    found.heat.push_back(of_scatterer - (totals.energy[i] - of_scatterer) / (2 * zeta));
  }
  return found;
}

inline void print(const std::vector<double>& before, const std::vector<double>& after) {
  const std::size_t cells = before.size();
  for (std::size_t r = 0; r < cells; ++r) {
    double sum = 0;
    for (std::size_t i = 0; i < cells; ++i) sum += before[i] * after[(i + r) % cells];
    std::printf("%.17g ", sum / static_cast<double>(cells));
  }
}

/// Correlations of a closed chain in the stationary state by the reference simulator, with independent random
/// numbers and initial states and no code shared with the engine or the program correlation. Prints one line
/// per replica: for the momentum and for E_s - E_p/(2 zeta) of a cell, and for every distance r = 0, 1, ...
/// on the ring, the mean over cells of a_i(0) a_{i+r}(lag). Cells extend from one scatterer to the next.
inline void run_correlation(const Arguments& of) {
  const std::size_t cells = of.count("cells");
  const double zeta = of.number("fugacity"), sigma = of.number("sigma"),
               temperature = of.number("temperature"), slowest = of.number("slowest"), lag = of.number("lag");
  std::mt19937_64 generator(of.count("seed"));
  std::normal_distribution<> gaussian;
  std::uniform_real_distribution<> uniform;
  const double fastest = 9 * std::sqrt(temperature);
  // Particles of the density 2 zeta/|p| per cell, kept with the probability exp(-p^2/2T).
  const double range = std::log(fastest / slowest);
  std::poisson_distribution<> of_envelope(2 * zeta * range * static_cast<double>(cells));
  for (std::size_t replica = 0; replica < of.count("replicas"); ++replica) {
    std::vector<double> x, p, P;
    for (int left = of_envelope(generator); left > 0; --left) {
      const double speed = slowest * std::exp(range * uniform(generator));
      if (uniform(generator) > std::exp(-speed * speed / (2 * temperature))) continue;
      x.push_back(static_cast<double>(cells) * uniform(generator));
      p.push_back(uniform(generator) < 0.5 ? speed : -speed);
    }
    for (std::size_t i = 0; i < cells; ++i)
      P.push_back(std::sqrt(temperature * (1 + sigma) / (1 - sigma)) * gaussian(generator));
    HeapSimulator<double> chain(sigma, 1, x, p, P);
    HeapSimulator<double>::Event event{};
    const Fields before = fields(chain, 0, zeta);
    while (chain.step(lag, event)) {
    }
    const Fields after = fields(chain, lag, zeta);
    print(before.momentum, after.momentum);
    print(before.heat, after.heat);
    std::printf("\n");
  }
}

}  // namespace reference
