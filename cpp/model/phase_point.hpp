#pragma once

#include <cstdint>
#include <vector>

namespace lorentz {

struct Particle {
  double position;  // from the left end, in [0, cells * cell_length)
  double velocity;  // u = p/sqrt(m)
  std::uint64_t draws =
      0;  // random numbers that it has taken, so that a simulation that goes on repeats none
};

/// Every degree of freedom of a chain at one time.
struct PhasePoint {
  std::vector<Particle> particles;
  std::vector<double> scatterers;  // U = P/sqrt(M), one per cell
};

}  // namespace lorentz
