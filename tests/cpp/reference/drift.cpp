/// Energy drift of the reference simulator for three floating-point types: for each a line with its name, the
/// number of events and |E(t)/E(0) - 1|. The initial state, in double precision, is the same for all.
///
///   reference_drift cells particles_per_cell sigma temperature time seed
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <random>
#include <vector>

#include "reference/heap_simulator.hpp"

namespace {

template <class Real>
void drift(const char* name, char** argv) {
  const auto number = [&](int i) { return std::atof(argv[i]); };
  const auto cells = static_cast<std::size_t>(number(1));
  const double particles_per_cell = number(2), root_temperature = std::sqrt(number(4));
  const Real sigma = static_cast<Real>(number(3)), root_mass = std::sqrt((1 + sigma) / (1 - sigma));
  std::mt19937_64 generator(static_cast<std::uint64_t>(number(6)));
  std::normal_distribution<> gaussian;
  std::uniform_real_distribution<> uniform(0, static_cast<double>(cells));
  std::vector<Real> x, p, P;
  for (double i = 0; i < static_cast<double>(cells) * particles_per_cell; ++i) {
    x.push_back(static_cast<Real>(uniform(generator)));
    p.push_back(static_cast<Real>(root_temperature * gaussian(generator)));
  }
  for (std::size_t i = 0; i < cells; ++i)
    P.push_back(root_mass * static_cast<Real>(root_temperature * gaussian(generator)));

  reference::HeapSimulator<Real> simulator(sigma, 1, x, p, P);
  const auto energy = [&](Real time) {
    const std::vector<Real> parts = simulator.cell_energies(time);
    return std::accumulate(parts.begin(), parts.end(), 0.0L);
  };
  const long double before = energy(0);
  const auto end = static_cast<Real>(number(5));
  typename reference::HeapSimulator<Real>::Event event{};
  long events = 0;
  while (simulator.step(end, event)) ++events;
  std::printf("%s %ld %.3Lg\n", name, events, std::abs(energy(end) / before - 1));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 7) return 2;
  drift<float>("float", argv);
  drift<double>("double", argv);
  drift<long double>("long_double", argv);
}
