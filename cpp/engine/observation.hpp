#pragma once

#include <cstdint>

namespace lorentz {

/// An observer is a class with hooks for the events that it measures: on_collision(const Collision&) and
/// on_flight(const Departure&) of a closed chain (engine/scattering.hpp), on_flight(const Path&) of an open
/// one (engine/path.hpp), whose further hooks are at simulate() in engine/open_dynamics.hpp.
///
/// A collision of a particle with a scatterer. Velocities are energy-normalised, u = p/sqrt(m) and U =
/// P/sqrt(M): u^2/2 and U^2/2 are energies, U^2 is the temperature of a scatterer, and with m = 1 u is the
/// momentum of the particle. Positive velocities are to the right.
struct Collision {
  double time;              // from the start of the replica; of a ClosedRun on its clock()
  std::uint32_t particle;   // number, from 0; in an open chain free for another once the particle has left
  std::uint32_t scatterer;  // number of the cell, from 0
  double particle_before, particle_after;    // u of the particle
  double scatterer_before, scatterer_after;  // U of the scatterer
};

/// For stretches of time that are not observed, such as a relaxation.
struct NoObserver {};

/// An event that the observer has no hook for costs nothing.
template <class Observer>
[[gnu::always_inline]] inline void notify(Observer& observer, const Collision& collision) {
  if constexpr (requires { observer.on_collision(collision); }) observer.on_collision(collision);
}

}  // namespace lorentz
