#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <random>
#include <vector>

#include "reference/arguments.hpp"
#include "reference/heap_simulator.hpp"

namespace reference {

/// Energy pulse by the reference simulator, with independent random numbers and initial states and no code
/// shared with the engine or the program energy_pulse. Prints one line per replica: the mean over its pairs
/// of the energy per cell with the pulse minus without, all cells at the first time, all cells at the second,
/// ... Both trajectories start from the same state.
struct Pulse {
  Arguments of;
  std::size_t cells = of.count("cells"), particles_per_cell = of.count("particles-per-cell");
  double sigma = of.number("sigma"), gamma = of.number("gamma"), energy = of.number("energy"),
         pulse_energy = of.number("pulse-energy");
  std::vector<double> times = of.list("times");

  void run() const;
  double root_mass() const { return std::sqrt((1 + sigma) / (1 - sigma)); }
};

struct PulseStart {
  std::vector<double> x, p, P;
};

/// Initial state with Gaussian momenta of particles and scatterers; cells of length 1.
inline PulseStart draw_start(const Pulse& pulse, std::mt19937_64& generator) {
  std::normal_distribution<> gaussian;
  std::uniform_real_distribution<> uniform;
  const double thermal = std::sqrt(2 * pulse.energy);
  PulseStart start;
  for (std::size_t i = 0; i < pulse.cells * pulse.particles_per_cell; ++i) {
    start.x.push_back(static_cast<double>(i / pulse.particles_per_cell) + uniform(generator));
    start.p.push_back(thermal * gaussian(generator));
  }
  for (std::size_t i = 0; i < pulse.cells; ++i)
    start.P.push_back(pulse.root_mass() * thermal * gaussian(generator));
  return start;
}

inline PulseStart with_pulse(const Pulse& pulse, PulseStart start) {
  const std::size_t central = (pulse.cells - 1) / 2;
  const std::size_t begin = central * pulse.particles_per_cell, end = begin + pulse.particles_per_cell;
  double energy = std::pow(start.P[central] / pulse.root_mass(), 2) / 2;
  for (std::size_t i = begin; i < end; ++i) energy += start.p[i] * start.p[i] / 2;
  const auto degrees_of_freedom = static_cast<double>(pulse.particles_per_cell + 1);
  const double factor = std::sqrt(degrees_of_freedom * pulse.pulse_energy / energy);
  for (std::size_t i = begin; i < end; ++i) start.p[i] *= factor;
  start.P[central] *= factor;
  return start;
}

/// Adds the energy differences of one pair to the sums.
inline void add_pair(const Pulse& pulse, std::mt19937_64& generator, std::vector<double>& sums) {
  const PulseStart start = draw_start(pulse, generator);
  const PulseStart pulsed = with_pulse(pulse, start);
  HeapSimulator<double> plain(pulse.sigma, 1, start.x, start.p, start.P),
      perturbed(pulse.sigma, 1, pulsed.x, pulsed.p, pulsed.P);
  const double probability = pulse.gamma / static_cast<double>(pulse.cells);
  plain.scatter_with(probability, generator());
  perturbed.scatter_with(probability, generator());
  for (std::size_t k = 0; k < pulse.times.size(); ++k) {
    HeapSimulator<double>::Event event{};
    while (plain.step(pulse.times[k], event)) {
    }
    while (perturbed.step(pulse.times[k], event)) {
    }
    const std::vector<double> without = plain.cell_energies(pulse.times[k]);
    const std::vector<double> with = perturbed.cell_energies(pulse.times[k]);
    for (std::size_t cell = 0; cell < pulse.cells; ++cell)
      sums[k * pulse.cells + cell] += with[cell] - without[cell];
  }
}

inline void Pulse::run() const {
  std::mt19937_64 generator(of.count("seed"));
  const double pairs = of.number("pairs-per-replica");
  for (std::size_t replica = 0; replica < of.count("replicas"); ++replica) {
    std::vector<double> sums(times.size() * cells, 0);
    for (double pair = 0; pair < pairs; ++pair) add_pair(*this, generator, sums);
    for (const double sum : sums) std::printf("%.17g ", sum / pairs);
    std::printf("\n");
  }
}

}  // namespace reference
