#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/flight.hpp"
#include "engine/piles.hpp"

namespace lorentz {

/// Pending flights in the order of (time, particle): the particle's number breaks ties, so simultaneous
/// events have a defined order that depends on nothing else.
///
/// Nothing ever invalidates a pending flight, so insert and take-minimum suffice. A timing wheel of
/// narrow buckets (a fraction of an event each) holds the flights of the current turn, piles of one turn each
/// the later ones, one more pile the rest. Buckets are linked lists through the places of the current pile,
/// and a bitmap finds the next occupied bucket: O(1) per event, no allocation.
/// Arrivals at or after end_time are frozen: kept, never queued. Particles may come and go.
///
/// In a large population almost every flight passes through a pile. It moves there itself, so that nothing is
/// read in random order but the flights of one turn, which is short enough for them to stay in the
/// second-level cache.
///
/// The bucket width follows the measured rate of events. It is a matter of speed only: the order is
/// exact for every width, because floor(time / width) is monotone in time also when rounded.
class EventQueue {
 public:
  /// rate: expected events per unit time, for the first turn.
  EventQueue(const std::vector<Flight>& flights, double rate, double end_time);

  /// Places of flights in memory, in use or not.
  std::size_t places() const { return piles_.places(); }

  /// Takes out the first flight that arrives before `until` (at most end_time, never falling); false if there
  /// is none.
  bool take_before(double until, Flight& flight) {
    for (;;) {
      while (word_bits_ == 0) {
        if (word_ + 1 < occupied_.size())
          word_bits_ = std::exchange(occupied_[++word_], 0);
        else if (!begin_turn(until))
          return false;
      }
      const std::size_t bucket = bucket_of(word_, word_bits_);
      const std::uint32_t head = lists_[bucket];
      if (next_[head] == Piles::nowhere) {
        if (!(piles_[head].time < until)) return false;
        lists_[bucket] = Piles::nowhere;
        word_bits_ &= word_bits_ - 1;
        vacant_ = head;
      } else {
        vacant_ = take_first_of_list(bucket, until);
        if (vacant_ == Piles::nowhere) return false;
      }
      ++counted_;
      flight = piles_[vacant_];
      return true;
    }
  }

  /// A flight that arrives no earlier than the one that was taken last, or than the last `until`. Inlined, so
  /// that the flight stays in registers, which docs/numerics.md has measured.
  [[gnu::always_inline]] void schedule(const Flight& flight) {
    if (!(flight.time < end_time_)) {
      piles_.append(frozen(), flight);
      return;
    }
    const std::uint64_t tick = tick_of(flight.time);
    if (tick < turn_end_) {
      link(settle(flight), tick);
    } else {
      piles_.append(pile_of(tick), flight);
      ++waiting_;
    }
  }

  /// Every flight that is pending or frozen, by the number of its particle; without a particle, one that
  /// never arrives, at rest.
  std::vector<Flight> flights() const;

  /// From now on all times, that of the end too, are counted from `origin`, which no pending arrival
  /// precedes.
  void shift(double origin);

 private:
  std::uint64_t tick_of(double time) const {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(time * ticks_per_time_));
  }

  /// The first bucket among the bits of a word of occupied_.
  static std::size_t bucket_of(std::size_t word, std::uint64_t bits) {
    return (word << 6) + static_cast<std::size_t>(std::countr_zero(bits));
  }

  // Piles: one per later turn, then these.
  std::size_t turns() const { return turn_mask_ + 1; }
  std::size_t rest() const { return turns(); }
  std::size_t current() const { return turns() + 1; }
  std::size_t frozen() const { return turns() + 2; }

  std::size_t pile_of(std::uint64_t tick) const {
    const std::uint64_t turn = tick >> bucket_bits_;
    return turn < piles_end_ ? turn & turn_mask_ : rest();
  }

  std::uint32_t take_first_of_list(std::size_t bucket, double until);

  /// A place in the current pile, if possible that of the flight that was taken last.
  std::uint32_t settle(const Flight& flight) {
    std::uint32_t place = std::exchange(vacant_, Piles::nowhere);
    if (place == Piles::nowhere) [[unlikely]] {
      place = piles_.append(current(), flight);
      if (piles_.places() > next_.size()) next_.resize(piles_.places());
    } else {
      piles_.write(place, flight);
    }
    return place;
  }

  void link(std::uint32_t place, std::uint64_t tick) {
    const std::uint64_t bucket = tick & bucket_mask_;
    const std::uint64_t bit = std::uint64_t{1} << (tick & 63);
    next_[place] = std::exchange(lists_[bucket], place);
    if (bucket >> 6 > word_) [[likely]] {
      occupied_[bucket >> 6] |= bit;
    } else {
      if (bucket >> 6 < word_) return_to(bucket >> 6);
      word_bits_ |= bit;
    }
  }

  /// Back to a word of the current turn that was passed when it was empty: a new particle arrives there.
  void return_to(std::size_t word) {
    occupied_[word_] = word_bits_;
    word_ = word;
    word_bits_ = std::exchange(occupied_[word], 0);
  }

  bool begin_turn(double until);
  bool replan(double until);
  void spread_rest();
  void rebuild(const std::vector<Flight>& flights, double rate, double now);
  std::vector<Flight> gathered() const;

  Piles piles_;
  std::vector<std::uint32_t> lists_;     // first place of every bucket
  std::vector<std::uint32_t> next_;      // of a place in its list
  std::vector<std::uint64_t> occupied_;  // one bit per bucket
  double end_time_;
  double ticks_per_time_ = 0;
  std::uint64_t bucket_mask_ = 0;  // number of buckets, a power of two, less 1
  std::uint64_t turn_mask_ = 0;    // the same of the later turns' piles
  int bucket_bits_ = 0;
  std::uint32_t vacant_ = Piles::nowhere;
  std::size_t word_ = 0;            // of occupied_; the words below it are done with
  std::uint64_t word_bits_ = 0;     // stands for occupied_[word_], which is 0
  std::uint64_t turn_end_ = 0;      // first tick after the current turn
  std::uint64_t piles_end_ = 0;     // first turn after those of the piles
  std::size_t waiting_ = 0;         // flights beyond the current turn
  std::uint64_t counted_ = 0;       // events
  std::uint64_t counted_from_ = 0;  // since this tick
  std::size_t planned_for_ = 1;     // particles
};

}  // namespace lorentz
