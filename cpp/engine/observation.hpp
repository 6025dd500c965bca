#pragma once

#include <cstdint>

namespace lorentz {

/// What an observer of collisions sees. Velocities are energy-normalised: u^2/2 and U^2/2 are
/// energies.
struct Collision {
  double time;
  std::uint32_t particle;
  std::uint32_t scatterer;
  double particle_before, particle_after;    // u
  double scatterer_before, scatterer_after;  // U
};

/// For stretches of time that nobody watches, such as a relaxation.
struct NoObserver {};

}  // namespace lorentz
