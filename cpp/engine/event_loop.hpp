#pragma once

#include <concepts>
#include <cstdint>

#include "engine/event_queue.hpp"

namespace lorentz {

/// Counts an event. heartbeat(time) is called every 65536 events and may throw to stop.
template <std::invocable<double> Heartbeat>
void count_event(std::uint64_t& events, double time, Heartbeat&& heartbeat) {
  constexpr std::uint64_t events_per_heartbeat = 65536;
  if (++events % events_per_heartbeat == 0) heartbeat(time);
}

/// Takes every flight that ends before `until`, in the order of (time, particle). arrive(flight) processes
/// the collision and schedules the next flight.
template <std::invocable<Flight> Arrive, std::invocable<double> Heartbeat>
[[gnu::always_inline]] inline void process_arrivals(EventQueue& queue, double until, std::uint64_t& events,
                                                    Arrive&& arrive, Heartbeat&& heartbeat) {
  for (Flight flight; queue.take_before(until, flight);) {
    const double time = flight.time;
    arrive(flight);
    count_event(events, time, heartbeat);
  }
}

}  // namespace lorentz
