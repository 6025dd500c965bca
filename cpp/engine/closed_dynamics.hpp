#pragma once

#include <concepts>
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
  std::uint64_t events() const { return events_; }

  /// Position of every particle relative to the scatterer at the end of its flight: negative while it flies
  /// to the right.
  std::vector<double> positions_from_targets(double time) const;

  /// U of every scatterer.
  std::vector<double> scatterers() const;

  /// Everything at a time between the last event and the next: where simulate() stopped.
  PhasePoint phase_point(double time) const;

 private:
  template <class Observer, std::invocable<double> Heartbeat>
  friend void simulate(ClosedDynamics&, double, Observer&, Heartbeat&&);
  template <bool passing, CollisionRule Rule, class Observer, std::invocable<double> Heartbeat>
  void advance(const Rule& rule, double until, Observer& observer, Heartbeat&& heartbeat);

  ClosedChain chain_;
  Rules rule_;
  std::vector<double> scatterers_;  // w, see Elastic
  FreeFlight free_flight_;
  EventQueue queue_;
  std::uint64_t events_ = 0;
};

/// Advances the chain through every collision before `until`, in the order of time (ties: lower
/// particle first). Hooks of the observer, both optional (engine/observation.hpp): on_collision(const
/// Collision&) and on_flight(const Departure&). heartbeat(time) is called every 65536 events and may throw to
/// stop.
///
/// A particle with u = 0, or so slow that the flight's duration overflows, never arrives: it is frozen.
template <class Observer, std::invocable<double> Heartbeat>
void simulate(ClosedDynamics& chain, double until, Observer& observer, Heartbeat&& heartbeat) {
  const auto advance = [&](const auto& rule) {
    if (chain.free_flight_.passing())
      chain.advance<true>(rule, until, observer, heartbeat);
    else
      chain.advance<false>(rule, until, observer, heartbeat);
  };
  std::visit(advance, chain.rule_);
}

/// passing: see Scattering.
template <bool passing, CollisionRule Rule, class Observer, std::invocable<double> Heartbeat>
void ClosedDynamics::advance(const Rule& rule, double until, Observer& observer, Heartbeat&& heartbeat) {
  const Scattering<Rule, passing> scatter(chain_, rule);
  const double scale = rule.scatterer_scale();
  const auto arrive = [&](Flight flight) __attribute__((always_inline)) {
    const std::uint32_t cell = flight.target;
    const double particle = flight.velocity, scatterer = scatterers_[cell];
    const Departure departure = scatter(flight, scatterers_[cell], free_flight_);
    notify(observer, Collision{departure.time, flight.particle, cell, particle, departure.velocity,
                               scale * scatterer, scale * scatterers_[cell]});
    if constexpr (requires { observer.on_flight(departure); }) observer.on_flight(departure);
    queue_.schedule(flight);
  };
  process_arrivals(queue_, until, events_, arrive, heartbeat);
}

}  // namespace lorentz
