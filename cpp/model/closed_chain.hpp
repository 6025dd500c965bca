#pragma once

#include <cstdint>
#include <limits>

namespace lorentz {

/// A ring of cells, each with one fixed scatterer at its centre. m = k_B = 1; lengths and momenta
/// set the unit of time.
struct ClosedChain {
  std::uint32_t cells = 11;
  std::uint32_t particles_per_cell = 20;
  double cell_length = 1;
  double sigma = 0.5;                                      // (M-m)/(M+m)
  double gamma = std::numeric_limits<double>::infinity();  // mean number of scatterings in N cells
  bool random_direction = false;                           // after a collision, as a control

  std::uint32_t particles() const { return cells * particles_per_cell; }
  bool deterministic() const { return gamma >= cells; }  // a particle scatters at every scatterer
};

/// The two invariants of the closed chain and the magnitude against which the second is compared.
/// The momentum is NaN where it is none: at sigma = 1, where scatterers are walls that take up any
/// momentum, and where the direction after a collision is drawn.
struct Invariants {
  double energy = 0;          // sum of u^2/2 + sum of U^2/2
  double momentum = 0;        // sum p + sum P
  double momentum_scale = 0;  // sum |p| + sum |P|
};

}  // namespace lorentz
