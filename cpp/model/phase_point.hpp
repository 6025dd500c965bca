#pragma once

#include <cstdint>
#include <vector>

namespace lorentz {

// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): always made with both
struct Particle {
  double position;  // from the left end, in [0, cells * cell_length)
  double velocity;  // u = p/sqrt(m)
  /// Random numbers drawn so far: a simulation continued from this state draws the next ones.
  std::uint64_t draws = 0;
};

/// State of a chain at one time, a point of its phase space.
struct PhasePoint {
  std::vector<Particle> particles;
  std::vector<double> scatterers;  // U = P/sqrt(M), one per cell
};

}  // namespace lorentz
