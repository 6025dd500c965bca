#pragma once

#include <cstdint>
#include <limits>

#include "model/rules/elastic.hpp"

namespace lorentz {

/// Parameters of a closed chain: a ring of cells, each with one fixed scatterer at its centre. Units: m = k_B
/// = 1; a momentum is a length over a time.
struct ClosedChain {
  std::uint32_t cells = 11;
  std::uint32_t particles_per_cell = 20;
  double cell_length = 1;
  double sigma = 0.5;                                      // (M-m)/(M+m)
  double gamma = std::numeric_limits<double>::infinity();  // mean number of scatterings in N cells
  RuleChoice rule{Elastic::properties.name};               // of collisions

  std::uint32_t particles() const { return cells * particles_per_cell; }
  bool deterministic() const { return gamma >= cells; }  // a particle scatters at every scatterer
};

/// Energy and momentum of a closed chain [eq. 4], with the scale of the momentum's error. The momentum is NaN
/// if the collision rule does not conserve it, and at sigma = 1, where the scatterers have infinite mass.
struct Invariants {
  double energy = 0;          // sum of u^2/2 + sum of U^2/2
  double momentum = 0;        // sum p + sum P
  double momentum_scale = 0;  // sum |p| + sum |P|
};

}  // namespace lorentz
