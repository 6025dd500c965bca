#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numeric>
#include <random>
#include <vector>

#include "reference/arguments.hpp"
#include "reference/heap_simulator.hpp"

namespace reference {

/// Prints the name of a floating-point type, the number of events, and |E(t)/E(0) - 1|.
template <class Real>
void print_drift(const char* name, const Arguments& of) {
  const std::size_t cells = of.count("cells");
  const double root_temperature = std::sqrt(of.number("temperature"));
  const Real exact_sigma = static_cast<Real>(of.number("sigma")),
             root_mass = std::sqrt((1 + exact_sigma) / (1 - exact_sigma));
  std::mt19937_64 generator(of.count("seed"));
  std::normal_distribution<> gaussian;
  std::uniform_real_distribution<> uniform(0, static_cast<double>(cells));
  std::vector<Real> x, p, P;
  for (std::size_t i = 0; i < cells * of.count("particles-per-cell"); ++i) {
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
  const auto end = static_cast<Real>(of.number("observation-time"));
  typename HeapSimulator<Real>::Event event{};
  long events = 0;
  while (simulator.step(end, event)) ++events;
  std::printf("%s %ld %.3Lg\n", name, events, std::abs(energy(end) / before - 1));
}

/// Energy drift of the reference simulator for three floating-point types, a line each. The initial state, in
/// double precision, is the same for all.
inline void run_drift(const Arguments& of) {
  print_drift<float>("float", of);
  print_drift<double>("double", of);
  print_drift<long double>("long_double", of);
}

}  // namespace reference
