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
/// Lauck, IEEE/ACM Trans. Netw. 5, 824 (1997), doi:10.1109/90.650142). The particle's number breaks ties.
///
/// The first level holds the flights of the current revolution in buckets narrower than the mean interval
/// between events. A bucket is a linked list; a bitmap finds the next occupied one. The second level holds
/// later flights, in one unordered list per revolution modulo the number of lists. A flight that is still
/// early when its list is due goes back to that list. Nothing invalidates a pending flight, so insert and
/// take-minimum suffice. Arrivals at or after end_time are frozen: kept, never taken.
///
/// The bucket width follows the measured rate of events. It affects speed only: floor(time / width) is
/// monotone in time, also when rounded, so the order is exact for every width.
class EventQueue {
 public:
  /// rate: expected events per unit time, for the first revolution.
  EventQueue(const std::vector<Flight>& flights, double rate, double end_time);

  /// Takes out the first flight that arrives before `until`, which never falls; false if there is none.
  bool take_before(double until, Flight& flight) {
    for (;;) {
      while (word_bits_ == 0) {
        if (word_ + 1 < occupied_.size())
          word_bits_ = std::exchange(occupied_[++word_], 0);
        else if (!begin_revolution(until))
          return false;
      }
      const std::size_t bucket = (word_ << 6) + static_cast<std::size_t>(std::countr_zero(word_bits_));
      const std::uint32_t head = buckets_[bucket];
      if (next_[head] == none) {
        if (!(lists_[head].time < until)) return false;
        buckets_[bucket] = none;
        word_bits_ &= word_bits_ - 1;
        vacant_ = head;
      } else {
        vacant_ = take_first_of(bucket, until);
        if (vacant_ == none) return false;
      }
      ++counted_;
      flight = lists_[vacant_];
      return true;
    }
  }

  /// Adds a flight that arrives no earlier than the last one taken, or than the last `until`. Inlined, so
  /// that the flight stays in registers; by reference an event takes 1.05 to 1.15 times as long.
  [[gnu::always_inline]] void schedule(const Flight& flight) {
    if (!(flight.time < end_time_)) {
      lists_.append(frozen(), flight);
      return;
    }
    const std::uint64_t tick = tick_of(flight.time);
    if (tick < revolution_end_) {
      link(place_in_revolution(flight), tick);
    } else {
      lists_.append(list_of(tick), flight);
      ++waiting_;
    }
  }

  /// Pending and frozen flights by the number of their particle.
  std::vector<Flight> flights() const;

  /// Counts all times, end_time too, from `origin` on, which no pending arrival precedes.
  void shift(double origin);

  /// Flights that the memory in use has room for.
  std::size_t places() const { return lists_.places(); }

 private:
  static constexpr std::uint32_t none = 0xffffffff;  // no place

  std::uint64_t tick_of(double time) const {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(time * ticks_per_time_));
  }

  std::size_t list_of(std::uint64_t tick) const { return (tick >> bucket_bits_) & list_mask_; }
  std::size_t current() const { return list_mask_ + 1; }  // list of the current revolution
  std::size_t frozen() const { return list_mask_ + 2; }   // list

  /// The place of the flight that was taken last serves again.
  [[gnu::always_inline]] std::uint32_t place_in_revolution(const Flight& flight) {
    std::uint32_t place = std::exchange(vacant_, none);
    if (place == none) [[unlikely]] {
      place = lists_.append(current(), flight);
      if (next_.size() < lists_.places()) [[unlikely]]
        grow();
    } else {
      lists_.write(place, flight);
    }
    return place;
  }

  /// The bits of the word in use are held apart from the bitmap: a test with a predictable branch replaces
  /// a load that waits for the last store to the bitmap. An event takes 0.75 to 1.0 times as long, by
  /// processor.
  [[gnu::always_inline]] void link(std::uint32_t place, std::uint64_t tick) {
    const std::uint64_t bucket = tick & bucket_mask_;
    const std::uint64_t bit = std::uint64_t{1} << (tick & 63);
    next_[place] = std::exchange(buckets_[bucket], place);
    if (bucket >> 6 > word_) [[likely]] {
      occupied_[bucket >> 6] |= bit;
    } else {
      if (bucket >> 6 < word_) return_to(bucket >> 6);
      word_bits_ |= bit;
    }
  }

  /// Goes back to a word that was empty: a new particle arrives there.
  void return_to(std::size_t word) {
    occupied_[word_] = word_bits_;
    word_ = word;
    word_bits_ = 0;
  }

  [[gnu::cold]] void grow();
  std::uint32_t take_first_of(std::size_t bucket, double until);
  bool begin_revolution(double until);
  bool adapt(double until);
  void rebuild(const std::vector<Flight>& flights, double rate, double now);

  ChunkedLists lists_;                   // later revolutions, then current() and frozen()
  std::vector<std::uint32_t> buckets_;   // first place of each, or none
  std::vector<std::uint32_t> next_;      // place in the same bucket, or none; by place
  std::vector<std::uint64_t> occupied_;  // one bit per bucket
  std::size_t word_ = 0;                 // of occupied_; those before it are 0
  std::uint64_t word_bits_ = 0;          // bits of that word, which is itself 0
  std::uint32_t vacant_ = none;          // place of the flight that was taken last
  double end_time_;
  double ticks_per_time_ = 0;         // a tick is the width of a bucket
  std::uint64_t bucket_mask_ = 0;     // number of buckets, a power of two, less 1
  std::uint64_t list_mask_ = 0;       // number of later revolutions' lists, a power of two, less 1
  int bucket_bits_ = 0;               // log2 of the number of buckets
  std::uint64_t revolution_end_ = 0;  // first tick after the current revolution
  std::size_t waiting_ = 0;           // flights that arrive in later revolutions
  std::size_t planned_for_ = 1;       // particles
  std::uint64_t counted_ = 0;         // events since counted_from_
  std::uint64_t counted_from_ = 0;    // tick
};

}  // namespace lorentz
