#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numeric>
#include <random>
#include <vector>

#include "reference/heap_simulator.hpp"

namespace reference {

/// Energy drift of the reference simulator for three floating-point types: for each a line with its name, the
/// number of events and |E(t)/E(0) - 1|. The initial state, in double precision, is the same for all.
struct Drift {
  std::size_t cells;
  double particles_per_cell, sigma, temperature, time;
  std::uint64_t seed;

  void run() const {
    run_with<float>("float");
    run_with<double>("double");
    run_with<long double>("long_double");
  }
  template <class Real>
  void run_with(const char* name) const;
};

template <class Real>
void Drift::run_with(const char* name) const {
  const double root_temperature = std::sqrt(temperature);
  const Real exact_sigma = static_cast<Real>(sigma),
             root_mass = std::sqrt((1 + exact_sigma) / (1 - exact_sigma));
  std::mt19937_64 generator(seed);
  std::normal_distribution<> gaussian;
  std::uniform_real_distribution<> uniform(0, static_cast<double>(cells));
  std::vector<Real> x, p, P;
  for (double i = 0; i < static_cast<double>(cells) * particles_per_cell; ++i) {
    x.push_back(static_cast<Real>(uniform(generator)));
    p.push_back(static_cast<Real>(root_temperature * gaussian(generator)));
  }
  for (std::size_t i = 0; i < cells; ++i)
    P.push_back(root_mass * static_cast<Real>(root_temperature * gaussian(generator)));

  HeapSimulator<Real> simulator(exact_sigma, 1, x, p, P);
  const auto energy = [&](Real now) {
    const std::vector<Real> parts = simulator.cell_energies(now);
    return std::accumulate(parts.begin(), parts.end(), 0.0L);
  };
  const long double before = energy(0);
  const auto end = static_cast<Real>(time);
  typename HeapSimulator<Real>::Event event{};
  long events = 0;
  while (simulator.step(end, event)) ++events;
  std::printf("%s %ld %.3Lg\n", name, events, std::abs(energy(end) / before - 1));
}

}  // namespace reference
