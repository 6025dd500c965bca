#pragma once

#include <concepts>
#include <cstdint>
#include <vector>

#include "engine/event_queue.hpp"
#include "engine/launch.hpp"
#include "engine/observation.hpp"
#include "engine/scattering.hpp"
#include "model/closed_chain.hpp"
#include "model/phase_point.hpp"

namespace lorentz {

/// A closed chain in motion.
class ClosedDynamics {
 public:
  /// Arrivals at or after end_time (> 0) are frozen; simulate() can go no further. key: of the draws
  /// that gamma < N and a random direction need.
  ClosedDynamics(const ClosedChain& chain, const PhasePoint& start, double end_time, const StreamKey& key);

  /// The clock shows 0 at what was `time`, where simulate() stopped. A clock resolves 2^-53 of what it shows,
  /// so that it must not show much more than a flight takes.
  void restart_clock(double time) { queue_.shift(time); }

  Invariants invariants() const;
  std::uint64_t events() const { return events_; }

  std::uint32_t particles() const { return chain_.particles(); }

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
  template <bool launching, class Observer, std::invocable<double> Heartbeat>
  void advance(double until, Observer& observer, Heartbeat&& heartbeat);

  ClosedChain chain_;
  Scattering scatter_;
  std::vector<double> scatterers_;  // w, see CollisionRule
  Launch launch_;
  EventQueue queue_;
  std::uint64_t events_ = 0;
};

/// Advances the chain through every collision before `until`, in the order of time (ties: lower
/// particle first). The observer may define on_collision(const Collision&) and on_flight(const
/// Departure&); what it does not define costs nothing. heartbeat(time) is called every 65536 events and
/// may throw to stop.
///
/// A particle with u = 0, or so slow that the flight's duration overflows, never arrives: it is frozen.
template <class Observer, std::invocable<double> Heartbeat>
void simulate(ClosedDynamics& chain, double until, Observer& observer, Heartbeat&& heartbeat) {
  if (chain.launch_.deterministic())
    chain.advance<false>(until, observer, heartbeat);
  else
    chain.advance<true>(until, observer, heartbeat);
}

/// launching: whether Launch has a say, see Scattering.
template <bool launching, class Observer, std::invocable<double> Heartbeat>
void ClosedDynamics::advance(double until, Observer& observer, Heartbeat&& heartbeat) {
  constexpr std::uint64_t events_per_heartbeat = 65536;
  const Scattering scatter = scatter_;
  const double scale = scatter.rule().scatterer_scale();

  for (Flight flight; queue_.take_before(until, flight);) {
    const std::uint32_t cell = flight.target;
    const double particle = flight.velocity;
    const double scatterer = scatterers_[cell];
    const Departure departure = scatter.template operator()<launching>(flight, scatterers_[cell], launch_);
    if constexpr (requires(const Collision& collision) { observer.on_collision(collision); }) {
      observer.on_collision(Collision{departure.time, flight.particle, cell, particle, departure.velocity,
                                      scale * scatterer, scale * scatterers_[cell]});
    }
    if constexpr (requires(const Departure& seen) { observer.on_flight(seen); })
      observer.on_flight(departure);
    queue_.schedule(flight);
    if (++events_ % events_per_heartbeat == 0) heartbeat(departure.time);
  }
}

}  // namespace lorentz
