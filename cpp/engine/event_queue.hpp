#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/chunked_lists.hpp"
#include "engine/flight.hpp"

namespace lorentz {

/// Pending flights in the order of (time, particle): a hierarchical timing wheel of two levels (Varghese and
/// Lauck, IEEE/ACM Trans. Netw. 5, 824 (1997), doi:10.1109/90.650142). Flights of the current revolution are
/// in buckets, linked lists that a bitmap finds; later ones in one unordered list per revolution, modulo the
/// number of lists: a flight that is early when its list is due goes back to it. Arrivals at or after
/// end_time are frozen: kept, never taken. The width of a bucket follows the rate of events and affects speed
/// only: floor(time / width) is monotone in time, also when rounded.
class EventQueue {
 public:
  /// rate: expected events per unit time, for the first revolution.
  EventQueue(const std::vector<Flight>& flights, double rate, double end_time) : end_time_(end_time) {
    rebuild(flights, rate, 0);
  }

  /// Takes out the first flight that arrives before `until`; false if there is none. `until` must not
  /// decrease from call to call.
  [[gnu::always_inline]] bool take_before(double until, Flight& flight) {
    while (word_bits_ == 0) {
      if (word_ + 1 < occupied_.size())
        word_bits_ = std::exchange(occupied_[++word_], 0);
      else if (!begin_revolution(until))
        return false;
    }
    const std::size_t bucket = (word_ << 6) + static_cast<std::size_t>(std::countr_zero(word_bits_));
    const std::uint32_t head = buckets_[bucket];
    if (lists_.next(head) == none) {
      if (!(lists_[head].time < until)) return false;
      buckets_[bucket] = none;
      word_bits_ &= word_bits_ - 1;
      vacant_ = head;
    } else if ((vacant_ = take_first_of(bucket, until)) == none) {
      return false;
    }
    ++counted_;
    flight = lists_[vacant_];
    return true;
  }

  /// Adds a flight that arrives no earlier than the last one taken, or than the last `until`. Inlined, so
  /// that the flight stays in registers.
  [[gnu::always_inline]] void schedule(const Flight& flight) {
    if (!(flight.time < end_time_)) {
      lists_.append(frozen_, flight);
    } else if (const std::uint64_t tick = tick_of(flight.time); tick < revolution_end_) {
      link(slot_in_revolution(flight), tick);
    } else {
      lists_.append(later(tick), flight);
      ++waiting_;
    }
  }

  /// Pending and frozen flights by the number of their particle.
  std::vector<Flight> flights() const;

  /// Counts all times, end_time too, from `origin` on, which no pending arrival precedes.
  void shift(double origin);

  /// Flights that the memory in use has room for.
  std::size_t slots() const { return lists_.slots(); }

 private:
  static constexpr std::uint32_t none = 0xffffffff;  // no slot

  std::uint64_t tick_of(double time) const {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(time * ticks_per_time_));
  }
  ChunkedLists::List& later(std::uint64_t tick) {
    return later_[(tick >> bucket_bits_) & (later_.size() - 1)];
  }

  /// Reuses the slot of the flight that was taken last.
  [[gnu::always_inline]] std::uint32_t slot_in_revolution(const Flight& flight) {
    const std::uint32_t slot = std::exchange(vacant_, none);
    if (slot == none) [[unlikely]]
      return lists_.append(current_, flight);
    lists_.write(slot, flight);
    return slot;
  }

  /// The bits of the word in use are held apart from the bitmap, as a load of them from there would wait for
  /// the last store to it.
  [[gnu::always_inline]] void link(std::uint32_t slot, std::uint64_t tick) {
    const std::uint64_t bucket = tick & bucket_mask_, bit = std::uint64_t{1} << (tick & 63);
    lists_.next(slot) = std::exchange(buckets_[bucket], slot);
    if (bucket >> 6 > word_) [[likely]] {
      occupied_[bucket >> 6] |= bit;
    } else {
      if (bucket >> 6 < word_) {  // a new particle arrives in a word that was empty
        occupied_[word_] = std::exchange(word_bits_, 0);
        word_ = bucket >> 6;
      }
      word_bits_ |= bit;
    }
  }

  std::uint32_t take_first_of(std::size_t bucket, double until);
  bool begin_revolution(double until);
  void rebuild(const std::vector<Flight>& flights, double rate, double now);

  ChunkedLists lists_;
  std::vector<ChunkedLists::List> later_;        // by revolution, modulo their number, a power of two
  ChunkedLists::List current_ = 0, frozen_ = 0;  // the current revolution's, with vacant slots
  std::vector<std::uint32_t> buckets_;           // first slot of each, or none
  std::vector<std::uint64_t> occupied_;          // one bit per bucket
  std::uint64_t word_ = 0;                       // of occupied_; those before it are 0
  std::uint64_t word_bits_ = 0;                  // bits of that word, which is itself 0
  std::uint32_t vacant_ = none;                  // slot of the flight that was taken last
  double end_time_, ticks_per_time_ = 0;         // a tick is the width of a bucket
  std::uint64_t bucket_mask_ = 0;                // number of buckets, a power of two, less 1
  int bucket_bits_ = 0;                          // log2 of the number of buckets
  std::uint64_t revolution_end_ = 0;             // first tick after the current revolution
  std::size_t waiting_ = 0;                      // flights that arrive in later revolutions
  std::size_t planned_for_ = 1;                  // particles
  std::uint64_t counted_ = 0;                    // events of the current revolution
};

}  // namespace lorentz
