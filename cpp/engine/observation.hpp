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

/// For stretches of time that are not observed, such as a relaxation.
struct NoObserver {};

/// An event that the observer has no hook for costs nothing.
template <class Observer>
[[gnu::always_inline]] inline void notify(Observer& observer, const Collision& collision) {
  if constexpr (requires { observer.on_collision(collision); }) observer.on_collision(collision);
}

}  // namespace lorentz
