/// Energy pulse by the reference simulator, with independent random numbers and initial states and no code
/// shared with the engine or the program energy_pulse. Prints one line per replica: the mean over its pairs
/// of the energy per cell with the pulse minus without, all cells at the first time, all cells at the second,
/// ... Both trajectories start from the same state or, to measure the variance reduction by that, from
/// independent ones.
///
///   reference_pulse cells particles_per_cell sigma gamma energy pulse_energy pairs replicas seed
///                   shared|independent time...
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string_view>
#include <vector>

#include "reference/heap_simulator.hpp"

namespace {

using Simulator = reference::HeapSimulator<double>;

struct Pulse {
  std::size_t cells, particles_per_cell;
  double sigma, gamma, energy, pulse_energy;
  bool shared_start;
  std::vector<double> times;

  double root_mass() const { return std::sqrt((1 + sigma) / (1 - sigma)); }
};

struct Start {
  std::vector<double> x, p, P;
};

/// Initial state with Gaussian momenta of particles and scatterers; cells of length 1.
Start draw_start(const Pulse& pulse, std::mt19937_64& generator) {
  std::normal_distribution<> gaussian;
  std::uniform_real_distribution<> uniform;
  const double thermal = std::sqrt(2 * pulse.energy);
  Start start;
  for (std::size_t i = 0; i < pulse.cells * pulse.particles_per_cell; ++i) {
    start.x.push_back(static_cast<double>(i / pulse.particles_per_cell) + uniform(generator));
    start.p.push_back(thermal * gaussian(generator));
  }
  for (std::size_t i = 0; i < pulse.cells; ++i)
    start.P.push_back(pulse.root_mass() * thermal * gaussian(generator));
  return start;
}

Start with_pulse(const Pulse& pulse, Start start) {
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
void add_pair(const Pulse& pulse, std::mt19937_64& generator, std::vector<double>& sums) {
  const Start start = draw_start(pulse, generator);
  const Start pulsed = with_pulse(pulse, pulse.shared_start ? start : draw_start(pulse, generator));
  Simulator plain(pulse.sigma, 1, start.x, start.p, start.P),
      perturbed(pulse.sigma, 1, pulsed.x, pulsed.p, pulsed.P);
  const double probability = pulse.gamma / static_cast<double>(pulse.cells);
  plain.scatter_with(probability, generator());
  perturbed.scatter_with(probability, generator());
  for (std::size_t k = 0; k < pulse.times.size(); ++k) {
    Simulator::Event event{};
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

}  // namespace

int main(int argc, char** argv) {
  const auto number = [&](int i) { return std::atof(argv[i]); };
  if (argc < 12) return 2;
  Pulse pulse{static_cast<std::size_t>(number(1)),
              static_cast<std::size_t>(number(2)),
              number(3),
              number(4),
              number(5),
              number(6),
              std::string_view(argv[10]) == "shared",
              {}};
  for (int i = 11; i < argc; ++i) pulse.times.push_back(number(i));
  const double pairs = number(7);
  std::mt19937_64 generator(static_cast<std::uint64_t>(number(9)));
  for (int replica = 0; replica < static_cast<int>(number(8)); ++replica) {
    std::vector<double> sums(pulse.times.size() * pulse.cells, 0);
    for (int pair = 0; pair < static_cast<int>(pairs); ++pair) add_pair(pulse, generator, sums);
    for (const double sum : sums) std::printf("%.17g ", sum / pairs);
    std::printf("\n");
  }
}
