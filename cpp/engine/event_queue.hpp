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
  static constexpr std::uint32_t none = 0xffffffff;  // no slot

 public:
  /// rate: expected events per unit time, for the first revolution.
  EventQueue(const std::vector<Flight>& flights, double rate, double end_time) : end_time_(end_time) {
    rebuild(flights, rate, 0);
  }

  /// The queue during a loop over events, with its state in local variables, which the compiler keeps in
  /// registers. In its lifetime the queue changes through it alone; take_before() brings the queue up to
  /// date.
  class Cursor {
   public:
    explicit Cursor(EventQueue& queue) : queue_(queue) { load(); }
    Cursor(const Cursor&) = delete;
    Cursor& operator=(const Cursor&) = delete;

    /// Takes every flight that arrives before `until`, in order, and calls arrive(flight, cursor), which may
    /// return it by reschedule(). `until` must not decrease from call to call. every_revolution(time) is
    /// called when the revolution has no flight left, with its end, which may exceed `until`. After an
    /// exception of either the queue is unspecified and may only be destroyed.
    template <class Arrive, class EveryRevolution>
    [[gnu::always_inline]] void take_before(double until, const Arrive& arrive,
                                            const EveryRevolution& every_revolution) {
      until = until < end_time_ ? until : end_time_;
      for (;;) {
        while (word_bits_ == 0) {
          if (word_ + 1 < words_) {
            word_bits_ = std::exchange(occupied_[++word_], 0);
          } else {
            save();
            every_revolution(revolution_end_ / ticks_per_time_);
            if (!queue_.begin_revolution(until)) return;
            load();
          }
        }
        std::uint32_t& bucket =
            buckets_[(word_ << 6) + static_cast<std::size_t>(std::countr_zero(word_bits_))];
        const std::uint32_t head = bucket;
        if (next_[head] == none) {
          if (!(flights_[head].time < until)) break;
          bucket = none;
          word_bits_ &= word_bits_ - 1;
          slot_ = head;
        } else if ((slot_ = queue_.take_first_of(bucket, until)) == none) {
          break;
        }
        ++taken_;
        arrive(std::as_const(flights_[slot_]), *this);
      }
      save();
    }

    /// The number of flights taken.
    std::uint64_t taken() const { return taken_; }

    /// Puts the flight that was taken last back, with a later or equal time and a new velocity and target;
    /// with `draws` also a new number of draws.
    template <bool draws>
    [[gnu::always_inline]] void reschedule(const Flight& changed) {
      const double ticks = changed.time * ticks_per_time_;
      if (!(ticks < revolution_end_)) return add_later(changed, ticks);
      // Member by member: a block copy fails store-to-load forwarding from stores of single members.
      Flight& flight = flights_[slot_];
      flight.time = changed.time;
      flight.velocity = changed.velocity;
      flight.target = changed.target;
      if constexpr (draws) flight.draws = changed.draws;
      link(slot_, tick_at(ticks));
    }

    /// Adds a flight that arrives no earlier than the last one taken, or than the last `until`.
    void add(const Flight& flight) {
      const double ticks = flight.time * ticks_per_time_;
      if (!(ticks < revolution_end_) || !(flight.time < end_time_)) return add_later(flight, ticks);
      const std::uint64_t tick = tick_at(ticks);
      const std::uint32_t slot = queue_.lists_.append(queue_.current_, flight);
      find_flights();
      if (const std::uint64_t word = (tick & bucket_mask_) >> 6; word < word_) {  // it was empty
        occupied_[word_] = std::exchange(word_bits_, 0);
        word_ = word;
      }
      link(slot, tick);
    }

   private:
    friend class EventQueue;

    /// word_bits_ is a copy of the current word of the bitmap: to load the word again would stall on the last
    /// store to it.
    [[gnu::always_inline]] void link(std::uint32_t slot, std::uint64_t tick) {
      const std::uint64_t bucket = tick & bucket_mask_, bit = std::uint64_t{1} << (tick & 63);
      next_[slot] = std::exchange(buckets_[bucket], slot);
      if (bucket >> 6 > word_) [[likely]]
        occupied_[bucket >> 6] |= bit;
      else
        word_bits_ |= bit;
    }

    [[gnu::always_inline]] void add_later(const Flight& flight, double ticks) {
      queue_.add_later(flight, ticks);
      find_flights();
    }

    /// After a list has grown, which moves the flights.
    [[gnu::always_inline]] void find_flights() {
      flights_ = queue_.lists_.flights();
      next_ = queue_.lists_.links();
    }

    [[gnu::always_inline]] void load() {
      buckets_ = queue_.buckets_.data();
      occupied_ = queue_.occupied_.data();
      words_ = queue_.occupied_.size();
      find_flights();
      word_ = queue_.word_;
      word_bits_ = queue_.word_bits_;
      taken_ = queue_.taken_;
      ticks_per_time_ = queue_.ticks_per_time_;
      end_time_ = queue_.end_time_;
      bucket_mask_ = queue_.bucket_mask_;
      revolution_end_ = queue_.revolution_end_;
    }

    [[gnu::always_inline]] void save() const {
      queue_.word_ = word_;
      queue_.word_bits_ = word_bits_;
      queue_.taken_ = taken_;
    }

    EventQueue& queue_;
    std::uint32_t *buckets_, *next_;
    std::uint64_t* occupied_;
    Flight* flights_;
    std::uint64_t words_, word_, word_bits_, taken_, bucket_mask_;
    double ticks_per_time_, end_time_, revolution_end_;
    std::uint32_t slot_ = none;  // of the flight that was taken last
  };

  /// Pending and frozen flights by the number of their particle.
  std::vector<Flight> flights() const;

  /// Counts all times, end_time too, from `origin` on, which no pending arrival precedes.
  void shift(double origin);

  /// Flights that the memory in use has room for.
  std::size_t slots() const { return lists_.slots(); }

 private:
  /// Of a time before end_time, which is at 2^52 ticks at most; the cast of an infinite time is undefined.
  /// Through std::int64_t it is faster.
  [[gnu::always_inline]] static std::uint64_t tick_at(double ticks) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(ticks));
  }
  ChunkedLists::List& later(double ticks) {
    return later_[(tick_at(ticks) >> bucket_bits_) & (later_.size() - 1)];
  }

  [[gnu::always_inline]] void add_later(const Flight& flight, double ticks) {
    if (!(flight.time < end_time_)) {
      lists_.append(frozen_, flight);
    } else {
      lists_.append(later(ticks), flight);
      ++waiting_;
    }
  }

  std::uint32_t take_first_of(std::uint32_t& bucket, double until);
  bool begin_revolution(double until);
  void rebuild(const std::vector<Flight>& flights, double rate, double now);

  ChunkedLists lists_;
  std::vector<ChunkedLists::List> later_;        // by revolution, modulo their number, a power of two
  ChunkedLists::List current_ = 0, frozen_ = 0;  // the current revolution's, with vacant slots
  std::vector<std::uint32_t> buckets_;           // first slot of each, or none
  std::vector<std::uint64_t> occupied_;          // one bit per bucket
  std::uint64_t word_ = 0;                       // of occupied_; those before it are 0
  std::uint64_t word_bits_ = 0;                  // bits of that word, which is itself 0
  double end_time_, ticks_per_time_ = 0;         // a tick is the width of a bucket
  std::uint64_t bucket_mask_ = 0;                // number of buckets, a power of two, less 1
  int bucket_bits_ = 0;                          // log2 of the number of buckets
  double revolution_end_ = 0;                    // first tick after the current revolution
  std::size_t waiting_ = 0;                      // flights that arrive in later revolutions
  std::size_t planned_for_ = 1;                  // particles
  std::uint64_t taken_ = 0, counted_from_ = 0;   // flights taken: in all, before the current revolution
};

}  // namespace lorentz
