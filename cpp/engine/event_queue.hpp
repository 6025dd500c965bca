#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "engine/huge_pages.hpp"

namespace lorentz {

/// One particle on its way to a scatterer: its only pending event. Aligned so that none lies across two lines
/// of the cache.
struct alignas(32) Flight {
  double time;              // of arrival
  double velocity;          // u
  std::uint32_t target;     // scatterer
  std::uint32_t next;       // link of the bucket's list; EventQueue's own
  std::uint64_t draws = 0;  // random numbers that the particle has taken, see Launch
};

/// Pending flights in the order of (time, slot): the particle's slot breaks ties, so simultaneous
/// events have a defined order that depends on nothing else.
///
/// Nothing ever invalidates a pending flight, so insert and take-minimum suffice. A timing wheel of
/// narrow buckets (a fraction of an event each) holds the flights of the current turn, coarse buckets of
/// one turn each the later ones, one more the rest. Buckets are linked lists through the flights
/// themselves, and a bitmap finds the next occupied bucket: O(1) per event, no allocation.
/// Arrivals at or after end_time are frozen: kept, never queued. Particles may come and go; the slot of one
/// that is gone serves the next that comes.
///
/// In a large population almost every flight passes through a coarse bucket, and there its memory is fetched
/// anew. A coarse bucket is therefore several lists, walked side by side, and the next flight of each is
/// asked for while the others are dealt with, so that the fetches overlap; and a turn is short enough for its
/// flights to stay in the second-level cache from then on.
///
/// The bucket width follows the measured rate of events. It is a matter of speed only: the order is
/// exact for every width, because floor(time / width) is monotone in time also when rounded.
class EventQueue {
 public:
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  /// flights: one slot per particle. rate: expected events per unit time, for the first turn.
  EventQueue(const std::vector<Flight>& flights, double rate, double end_time);

  const std::vector<Flight, HugePageAllocator<Flight>>& flights() const { return flights_; }
  Flight& operator[](std::uint32_t slot) { return flights_[slot]; }
  double end_time() const { return end_time_; }

  /// Takes out the first flight that arrives before `until` (at most end_time, never falling). Returns its
  /// slot, or none. The caller gives the flight its next arrival, not earlier than this one, and schedules
  /// it; or releases the slot.
  std::uint32_t take_before(double until) {
    for (;;) {
      while (word_bits_ == 0) {
        if (word_ + 1 < occupied_.size())
          word_bits_ = std::exchange(occupied_[++word_], 0);
        else if (!begin_turn(until))
          return none;
      }
      const std::size_t bucket = (word_ << 6) + static_cast<std::size_t>(std::countr_zero(word_bits_));
      const std::uint32_t head = lists_[bucket];
      if (flights_[head].next != none) return take_first_of_list(bucket, until);
      if (!(flights_[head].time < until)) return none;
      lists_[bucket] = none;
      word_bits_ &= word_bits_ - 1;
      ++taken_in_turn_;
      return head;
    }
  }

  /// A slot for the flight of a particle that comes, arriving no earlier than the last `until`. The caller
  /// schedules it.
  std::uint32_t insert(const Flight& flight) {
    if (free_ == none) {
      flights_.push_back(flight);
      return static_cast<std::uint32_t>(flights_.size() - 1);
    }
    const std::uint32_t slot = free_;
    free_ = flights_[slot].next;
    flights_[slot] = flight;
    return slot;
  }

  /// The particle of a flight that was taken out is gone.
  void release(std::uint32_t slot) {
    flights_[slot].time = std::numeric_limits<double>::infinity();  // frozen, should the wheel be rebuilt
    flights_[slot].next = free_;
    free_ = slot;
  }

  /// From now on all times, end_time() too, are counted from `origin`, which no pending arrival precedes.
  void shift(double origin);

  void schedule(std::uint32_t slot) {
    const double time = flights_[slot].time;
    if (!(time < end_time_)) return;
    const std::uint64_t tick = tick_of(time);
    if (tick < turn_end_) {
      const std::uint64_t bucket = tick & bucket_mask_;
      const std::uint64_t bit = std::uint64_t{1} << (tick & 63);
      push(lists_[bucket], slot);
      if (bucket >> 6 > word_) [[likely]] {
        occupied_[bucket >> 6] |= bit;
      } else {
        if (bucket >> 6 < word_) return_to(bucket >> 6);
        word_bits_ |= bit;
      }
    } else {
      schedule_beyond_turn(slot, tick);
    }
  }

 private:
  static constexpr std::uint64_t lanes = 32;  // lists per coarse bucket

  std::uint64_t tick_of(double time) const {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(time * ticks_per_time_));
  }

  void push(std::uint32_t& list, std::uint32_t slot) {
    flights_[slot].next = list;
    list = slot;
  }

  std::uint32_t take_first_of_list(std::size_t bucket, double until);
  /// First of the lists of a later turn.
  std::size_t lists_of(std::uint64_t turn) const {
    const std::uint64_t coarse = turn < coarse_end_ ? turn & coarse_mask_ : coarse_mask_ + 1;
    return bucket_mask_ + 1 + coarse * lanes;
  }

  void schedule_beyond_turn(std::uint32_t slot, std::uint64_t tick) {
    push(lists_[lists_of(tick >> bucket_bits_) + slot % lanes], slot);
    ++waiting_;
  }

  void relink(std::size_t first_list);
  bool begin_turn(double until);
  void rebuild(double rate, double now);

  /// Back to a word of the current turn that was passed when it was empty: a new particle arrives there.
  void return_to(std::size_t word) {
    occupied_[word_] = word_bits_;
    word_ = word;
    word_bits_ = std::exchange(occupied_[word], 0);
  }

  std::vector<Flight, HugePageAllocator<Flight>> flights_;
  double end_time_;
  double ticks_per_time_ = 0;
  std::vector<std::uint32_t> lists_;     // heads: buckets, then lanes of the coarse ones and of the rest
  std::vector<std::uint64_t> occupied_;  // one bit per bucket
  std::uint64_t bucket_mask_ = 0;        // number of buckets, a power of two, less 1
  std::uint64_t coarse_mask_ = 0;        // the same of coarse buckets
  int bucket_bits_ = 0;
  std::size_t word_ = 0;          // of occupied_; the words below it are done with
  std::uint64_t word_bits_ = 0;   // stands for occupied_[word_], which is 0
  std::uint64_t turn_end_ = 0;    // first tick after the current turn
  std::uint64_t coarse_end_ = 0;  // first turn after those of the coarse buckets
  std::uint32_t free_ = none;     // list of released slots
  std::size_t waiting_ = 0;       // flights beyond the current turn
  std::uint64_t taken_in_turn_ = 0;
};

}  // namespace lorentz
