#pragma once

#include <concepts>
#include <cstdint>
#include <vector>

#include "engine/event_queue.hpp"
#include "model/closed_chain.hpp"
#include "model/collision.hpp"

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

/// A closed chain in motion.
class ClosedDynamics {
 public:
  /// Arrivals at or after end_time (> 0) are frozen; simulate() can go no further.
  ClosedDynamics(const ClosedChain& chain, const PhasePoint& start, double end_time);

  Invariants invariants() const;
  std::uint64_t events() const { return events_; }

 private:
  template <class Observer, std::invocable<double> Heartbeat>
  friend void simulate(ClosedDynamics&, double, Observer&, Heartbeat&&);

  std::uint32_t neighbour(std::uint32_t cell, double velocity) const {
    const std::uint32_t right = cell + 1 == chain_.cells ? 0 : cell + 1;
    const std::uint32_t left = cell == 0 ? chain_.cells - 1 : cell - 1;
    return velocity > 0 ? right : left;
  }

  ClosedChain chain_;
  CollisionRule collide_;
  std::vector<double> scatterers_;  // w, see CollisionRule
  EventQueue queue_;
  std::uint64_t events_ = 0;
};

/// Advances the chain through every collision before `until`, in the order of time (ties: lower
/// particle first). The observer may define on_collision(const Collision&); what it does not define
/// costs nothing. heartbeat(time) is called every 65536 events and may throw to stop.
///
/// A particle with u = 0, or so slow that cell_length/|u| overflows, never arrives: it is frozen.
template <class Observer, std::invocable<double> Heartbeat>
void simulate(ClosedDynamics& chain, double until, Observer& observer, Heartbeat&& heartbeat) {
  constexpr std::uint64_t events_per_heartbeat = 65536;
  const double cell_length = chain.chain_.cell_length;
  const double scale = chain.collide_.scatterer_scale();
  const CollisionRule collide = chain.collide_;
  EventQueue& queue = chain.queue_;

  for (std::uint32_t slot; (slot = queue.take_before(until)) != EventQueue::none;) {
    Flight& flight = queue[slot];
    const double velocity = flight.velocity;
    const double scatterer = chain.scatterers_[flight.target];
    double u = velocity;
    double w = scatterer;
    collide(u, w);
    chain.scatterers_[flight.target] = w;
    if constexpr (requires(const Collision& collision) { observer.on_collision(collision); }) {
      observer.on_collision(
          Collision{flight.time, slot, flight.target, velocity, u, scale * scatterer, scale * w});
    }
    flight.velocity = u;
    flight.target = chain.neighbour(flight.target, u);
    flight.time += cell_length / std::abs(u);
    queue.schedule(slot);
    if (++chain.events_ % events_per_heartbeat == 0) heartbeat(flight.time);
  }
}

/// For stretches of time that nobody watches, such as a relaxation.
struct NoObserver {};

}  // namespace lorentz
