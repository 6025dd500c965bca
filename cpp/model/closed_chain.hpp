#pragma once

#include <cstdint>

#include "model/scatterers.hpp"

namespace lorentz {

/// Parameters of a closed chain, a ring of cells.
struct ClosedChain : Scatterers {
  std::uint32_t particles_per_cell = 20;

  std::uint32_t particles() const { return cells * particles_per_cell; }
};

/// Energy and momentum of a closed chain [eq. 3], with the scale of the momentum's error. The momentum is NaN
/// if the collision rule does not conserve it, and at sigma = 1, where the scatterers have infinite mass.
struct Invariants {
  double energy = 0;          // sum of u^2/2 + sum of U^2/2
  double momentum = 0;        // sum p + sum P
  double momentum_scale = 0;  // sum |p| + sum |P|
};

}  // namespace lorentz
