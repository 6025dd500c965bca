#pragma once

#include <cstdint>
#include <functional>
#include <utility>

#include "engine/event_queue.hpp"

namespace lorentz {

/// The dynamics call it with the time after at least 65536 more events. It may throw to stop, after which the
/// chain may only be destroyed.
using Heartbeat = std::function<void(double)>;

/// Counts events and calls the heartbeat.
class EventCounter {
 public:
  void add(std::uint64_t events, double time, const Heartbeat& heartbeat) {
    events_ += events;
    if (events_ >= next_heartbeat_) [[unlikely]] {
      next_heartbeat_ = events_ + 65536;
      heartbeat(time);
    }
  }
  std::uint64_t events() const { return events_; }

 private:
  std::uint64_t events_ = 0, next_heartbeat_ = 65536;
};

/// Takes every flight that arrives before `until`, in the order of (time, particle). arrive(flight, cursor)
/// processes the collision and lets the flight go on.
template <class Arrive>
[[gnu::always_inline]] inline void process_arrivals(EventQueue::Cursor& cursor, double until,
                                                    EventCounter& counter, const Arrive& arrive,
                                                    const Heartbeat& heartbeat) {
  std::uint64_t counted = cursor.taken();
  const auto count = [&](double time) {
    counter.add(cursor.taken() - std::exchange(counted, cursor.taken()), time, heartbeat);
  };
  cursor.take_before(until, arrive, count);
  count(until);
}

}  // namespace lorentz
