/// The energy pulse by the reference simulator: nothing here is shared with the engine or with the program
/// energy_pulse, random numbers and start included. Prints one line per replica: the mean over its members of
/// the energy per cell with the pulse minus without, all cells at the first time, all cells at the second...
///
///   reference_pulse cells particles_per_cell sigma gamma energy pulse_energy members replicas seed time...
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

#include "reference/heap_simulator.hpp"

namespace {

using Simulator = reference::HeapSimulator<double>;

struct Pulse {
  std::size_t cells, particles_per_cell;
  double sigma, gamma, energy, pulse_energy;
  std::vector<double> times;
};

/// Adds what one member finds to the sums. Gaussian start of particles and scatterers, cells of length 1.
void add_member(const Pulse& pulse, std::mt19937_64& generator, std::vector<double>& sums) {
  std::normal_distribution<> gaussian;
  std::uniform_real_distribution<> uniform;
  const double root_mass = std::sqrt((1 + pulse.sigma) / (1 - pulse.sigma));
  const double thermal = std::sqrt(2 * pulse.energy);
  std::vector<double> x, p, P;
  for (std::size_t i = 0; i < pulse.cells * pulse.particles_per_cell; ++i) {
    x.push_back(static_cast<double>(i / pulse.particles_per_cell) + uniform(generator));
    p.push_back(thermal * gaussian(generator));
  }
  for (std::size_t i = 0; i < pulse.cells; ++i) P.push_back(root_mass * thermal * gaussian(generator));

  const std::size_t central = (pulse.cells - 1) / 2;
  const std::size_t begin = central * pulse.particles_per_cell, end = begin + pulse.particles_per_cell;
  double energy = P[central] * P[central] / (2 * root_mass * root_mass);
  for (std::size_t i = begin; i < end; ++i) energy += p[i] * p[i] / 2;
  const double degrees_of_freedom = static_cast<double>(pulse.particles_per_cell + 1);
  const double factor = std::sqrt(degrees_of_freedom * pulse.pulse_energy / energy);
  std::vector<double> pulsed_p = p, pulsed_P = P;
  for (std::size_t i = begin; i < end; ++i) pulsed_p[i] *= factor;
  pulsed_P[central] *= factor;

  Simulator plain(pulse.sigma, 1, x, p, P), perturbed(pulse.sigma, 1, x, pulsed_p, pulsed_P);
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
  if (argc < 11) return 2;
  Pulse pulse{static_cast<std::size_t>(number(1)),
              static_cast<std::size_t>(number(2)),
              number(3),
              number(4),
              number(5),
              number(6),
              {}};
  for (int i = 10; i < argc; ++i) pulse.times.push_back(number(i));
  const double members = number(7);
  std::mt19937_64 generator(static_cast<std::uint64_t>(number(9)));
  for (int replica = 0; replica < static_cast<int>(number(8)); ++replica) {
    std::vector<double> sums(pulse.times.size() * pulse.cells, 0);
    for (int member = 0; member < static_cast<int>(members); ++member) add_member(pulse, generator, sums);
    for (const double sum : sums) std::printf("%.17g ", sum / members);
    std::printf("\n");
  }
}
