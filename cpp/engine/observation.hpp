#pragma once

#include <cstdint>

namespace lorentz {

/// An observer is a class with a hook for every kind of event that it measures:
///   on_collision(const Collision&)            both chains; below
///   on_scatterer(cell, double before, double time)  open chain; engine/open_dynamics.hpp
///   on_flight(const Departure&)               closed chain; engine/scattering.hpp
///   on_flight(const Path&)                    open chain; engine/path.hpp
///   on_injection(End, double time, double u)  open chain; engine/open_dynamics.hpp
///   on_exit(End, double time, double u)       open chain; engine/open_dynamics.hpp
/// Events without a hook cost nothing.
///
/// Velocities are energy-normalised, u = p/sqrt(m) and U = P/sqrt(M), and positive to the right: u^2/2 and
/// U^2/2 are energies, the mean of U^2 is the temperature of a scatterer, and with m = 1 u is the momentum of
/// the particle.

/// Collision of a particle with a scatterer.
struct Collision {
  double time;  // since the start of the replica; in a ClosedRun the time of its clock()
  std::uint32_t
      particle;  // number, from 0; in an open chain the number of a particle that has left is reused
  std::uint32_t scatterer;                   // number of the cell, from 0
  double particle_before, particle_after;    // u of the particle
  double scatterer_before, scatterer_after;  // U of the scatterer
  int neighbour = 0;  // 1: the rule changed the scatterer to the right, too; -1: to the left; 0: none
};

/// Observes nothing: for the relaxation.
struct NoObserver {};

template <class Observer>
[[gnu::always_inline]] inline void notify(Observer& observer, const Collision& collision) {
  if constexpr (requires { observer.on_collision(collision); }) observer.on_collision(collision);
}

/// before: U since the last change of this scatterer.
template <class Observer>
[[gnu::always_inline]] inline void notify_scatterer(Observer& observer, std::uint32_t cell, double before,
                                                    double time) {
  if constexpr (requires { observer.on_scatterer(cell, before, time); })
    observer.on_scatterer(cell, before, time);
}

/// A Departure or a Path.
template <class Observer, class Started>
[[gnu::always_inline]] inline void notify_flight(Observer& observer, const Started& flight) {
  if constexpr (requires { observer.on_flight(flight); }) observer.on_flight(flight);
}

}  // namespace lorentz
