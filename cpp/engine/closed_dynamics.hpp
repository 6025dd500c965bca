#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "engine/event_loop.hpp"
#include "engine/event_queue.hpp"
#include "engine/free_flight.hpp"
#include "engine/observation.hpp"
#include "engine/scattering.hpp"
#include "model/closed_chain.hpp"
#include "model/phase_point.hpp"
#include "model/rules.hpp"

namespace lorentz {

/// The dynamics of a closed chain.
class ClosedDynamics {
 public:
  /// The number of particles is that of the start.
  /// Arrivals at or after end_time (> 0) are frozen; simulate() goes no further. key: of the random numbers
  /// that gamma < N and the collision rule need.
  ClosedDynamics(const ClosedChain& chain, const PhasePoint& start, double end_time, const StreamKey& key);

  /// Sets the origin of time to `time`, where simulate() stopped: a clock resolves 2^-53 of its value.
  void restart_clock(double time) { queue_.shift(time); }

  Invariants invariants() const;
  std::uint64_t events() const { return events_.events(); }

  /// Position of every particle relative to the scatterer at the end of its flight: negative while it flies
  /// to the right.
  std::vector<double> positions_from_targets(double time) const;

  /// U of every scatterer.
  std::vector<double> scatterers() const;

  /// Everything at a time between the last event and the next: where simulate() stopped.
  PhasePoint phase_point(double time) const;

 private:
  template <class Observer>
  friend void simulate(ClosedDynamics&, double, Observer&, const Heartbeat&);
  template <bool passing, CollisionRule Rule, class Observer>
  void advance(const Rule& rule, double until, Observer& observer, const Heartbeat& heartbeat);

  ClosedChain chain_;
  Rules rule_;
  std::vector<double> scatterers_;  // w, see ScattererMass
  FreeFlight free_flight_;
  EventQueue queue_;
  EventCounter events_;
};

/// Advances the chain through every collision before `until`, in the order of time (ties: lower
/// particle first). Hooks of the observer, both optional (engine/observation.hpp): on_collision(const
/// Collision&) and on_flight(const Departure&).
///
/// A particle with u = 0, or so slow that the flight's duration overflows, never arrives: it is frozen.
template <class Observer>
void simulate(ClosedDynamics& chain, double until, Observer& observer, const Heartbeat& heartbeat) {
  const auto advance = [&](const auto& rule) {
    if (chain.free_flight_.passing())
      chain.advance<true>(rule, until, observer, heartbeat);
    else
      chain.advance<false>(rule, until, observer, heartbeat);
  };
  std::visit(advance, chain.rule_);
}

/// The relaxation, compiled once.
extern template void simulate(ClosedDynamics&, double, NoObserver&, const Heartbeat&);

/// passing: see Scattering.
template <bool passing, CollisionRule Rule, class Observer>
void ClosedDynamics::advance(const Rule& rule, double until, Observer& observer, const Heartbeat& heartbeat) {
  const Scattering<Rule, passing> scatter(chain_, rule);
  const double scale = rule.scatterer_scale();
  double* const scatterers = scatterers_.data();
  const auto arrive = [&](const Flight& arrival, EventQueue::Cursor& cursor) __attribute__((always_inline)) {
    constexpr bool draws = passing || DrawingRule<Rule>;
    Flight flight{arrival.time, arrival.velocity, arrival.target, arrival.particle};
    if constexpr (draws) flight.draws = arrival.draws;
    const std::uint32_t cell = flight.target;
    const double particle = flight.velocity, scatterer = scatterers[cell];
    const auto w = [scatterers](std::uint32_t at) -> double& { return scatterers[at]; };
    const Departure departure = scatter(flight, w, free_flight_);
    notify(observer, Collision{departure.time, flight.particle, cell, particle, departure.velocity,
                               scale * scatterer, scale * scatterers[cell], departure.neighbour});
    notify_flight(observer, departure);
    cursor.reschedule<draws>(flight);
  };
  EventQueue::Cursor cursor(queue_);
  process_arrivals(cursor, until, events_, arrive, heartbeat);
}

}  // namespace lorentz
