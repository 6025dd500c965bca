/// Correlations of a closed chain by the reference simulator, with independent random numbers and initial
/// states and no code shared with the engine or the program correlation. Prints one line per replica: for
/// number, energy and momentum of a cell, and for every distance r = 0, 1, ... on the ring, the mean over
/// cells of a_i(relaxation) a_{i+r}(relaxation
/// + lag), a being the deviation from its known mean.
///
///   reference_correlation cells particles_per_cell sigma temperature scatterer_temperature relaxation lag
///   replicas seed
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

#include "reference/heap_simulator.hpp"

namespace {

using Simulator = reference::HeapSimulator<double>;

void print(const std::vector<double>& before, const std::vector<double>& after, double mean) {
  const std::size_t cells = before.size();
  for (std::size_t r = 0; r < cells; ++r) {
    double sum = 0;
    for (std::size_t i = 0; i < cells; ++i) sum += (before[i] - mean) * (after[(i + r) % cells] - mean);
    std::printf("%.17g ", sum / static_cast<double>(cells));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 10) return 2;
  const auto number = [&](int i) { return std::atof(argv[i]); };
  const auto cells = static_cast<std::size_t>(number(1)), per_cell = static_cast<std::size_t>(number(2));
  const double sigma = number(3), temperature = number(4), of_scatterers = number(5);
  const double begin = number(6), end = begin + number(7);
  std::mt19937_64 generator(static_cast<std::uint64_t>(number(9)));
  std::normal_distribution<> gaussian;
  std::uniform_real_distribution<> uniform;
  for (int replica = 0; replica < static_cast<int>(number(8)); ++replica) {
    std::vector<double> x, p, P;
    for (std::size_t i = 0; i < cells * per_cell; ++i) {
      x.push_back(static_cast<double>(i / per_cell) + uniform(generator));
      p.push_back(std::sqrt(temperature) * gaussian(generator));
    }
    for (std::size_t i = 0; i < cells; ++i)
      P.push_back(std::sqrt(of_scatterers * (1 + sigma) / (1 - sigma)) * gaussian(generator));
    Simulator chain(sigma, 1, x, p, P);
    Simulator::Event event{};
    while (chain.step(begin, event)) {
    }
    const Simulator::Totals before = chain.totals(begin);
    while (chain.step(end, event)) {
    }
    const Simulator::Totals after = chain.totals(end);
    const auto n = static_cast<double>(per_cell);
    print(before.number, after.number, n);
    print(before.energy, after.energy, 0.5 * (n * temperature + of_scatterers));
    print(before.momentum, after.momentum, 0);
    std::printf("\n");
  }
}
