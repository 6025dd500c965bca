#include "engine/event_queue.hpp"

#include <algorithm>
#include <utility>

namespace lorentz {
namespace {

// By measurement (make bench). Mean number of events in a bucket: few enough that lists are rarely
// longer than one. Length of a turn, in events per particle: long turns send few flights through the
// coarse buckets, short ones keep the heads of a large population in the second-level cache.
constexpr double occupancy = 0.5;
constexpr std::size_t small_population = 8192;
constexpr std::size_t small_turn = 8;
constexpr std::size_t large_turn = 2;

std::size_t bucket_count(std::size_t particles) {
  const std::size_t turn = particles <= small_population ? small_turn : large_turn;
  const auto wanted = static_cast<std::size_t>(static_cast<double>(turn * particles) / occupancy);
  return std::bit_ceil(std::max<std::size_t>(64, wanted));
}

}  // namespace

EventQueue::EventQueue(std::vector<Flight> flights, double rate, double end_time)
    : flights_(std::move(flights)), end_time_(end_time), coarse_(coarse_buckets, none) {
  rebuild(rate, 0);
}

/// The wheel anew, for a rate of events and the present population; nothing arrives before `now`.
void EventQueue::rebuild(double rate, double now) {
  const std::size_t size = bucket_count(flights_.size());
  buckets_.assign(size, none);
  occupied_.assign(size / 64, 0);
  bucket_mask_ = size - 1;
  // More than 2^52 ticks would be finer than the clock itself.
  ticks_per_time_ = std::clamp(rate / occupancy, 1 / end_time_, 0x1p52 / end_time_);
  const std::uint64_t turn = tick_of(now) / size;
  turn_end_ = (turn + 1) * size;
  coarse_end_ = turn + 1 + coarse_buckets;
  word_ = 0;
  word_bits_ = 0;
  taken_in_turn_ = 0;
  waiting_ = 0;
  beyond_ = none;
  std::fill(coarse_.begin(), coarse_.end(), none);
  for (std::uint32_t slot = 0; slot < flights_.size(); ++slot) schedule(slot);
}

void EventQueue::shift(double origin) {
  for (Flight& flight : flights_) flight.time -= origin;
  end_time_ -= origin;
  rebuild(ticks_per_time_ * occupancy, 0);
}

std::uint32_t EventQueue::take_first_of_list(std::size_t bucket, double until) {
  std::uint32_t* link_to_first = &buckets_[bucket];
  std::uint32_t first = *link_to_first;
  for (std::uint32_t* link = &flights_[first].next; *link != none; link = &flights_[*link].next) {
    const double time = flights_[*link].time;
    const double first_time = flights_[first].time;
    if (time < first_time || (time == first_time && *link < first)) {
      link_to_first = link;
      first = *link;
    }
  }
  if (!(flights_[first].time < until)) return none;
  *link_to_first = flights_[first].next;
  ++taken_in_turn_;
  return first;
}

void EventQueue::schedule_beyond_turn(std::uint32_t slot, std::uint64_t tick) {
  const std::uint64_t turn = tick / buckets_.size();
  push(turn < coarse_end_ ? coarse_[turn % coarse_buckets] : beyond_, slot);
  ++waiting_;
}

bool EventQueue::begin_turn(double until) {
  // Before `until` a new particle may still arrive, so a turn that begins later has to wait.
  if (waiting_ == 0 || tick_of(std::min(until, end_time_)) < turn_end_) return false;
  // The wheel is empty now: a good moment to rebuild it when it no longer fits the rate or the population.
  const double filling =
      static_cast<double>(taken_in_turn_) / (occupancy * static_cast<double>(buckets_.size()));
  if (filling > 1.5 || filling < 0.5 || bucket_count(flights_.size()) > buckets_.size()) {
    double now = until;
    for (const Flight& flight : flights_) now = std::min(now, flight.time);
    rebuild(ticks_per_time_ * occupancy * std::clamp(filling, 0.125, 8.0), now);
    return true;
  }

  const auto relink = [this](std::uint32_t& list) {
    for (std::uint32_t slot = std::exchange(list, none); slot != none;) {
      const std::uint32_t next = flights_[slot].next;
      --waiting_;
      schedule(slot);
      slot = next;
    }
  };
  const std::uint64_t turn = turn_end_ / buckets_.size();
  turn_end_ += buckets_.size();
  word_ = 0;
  taken_in_turn_ = 0;
  if (turn == coarse_end_) {
    coarse_end_ += coarse_buckets;
    relink(beyond_);
  }
  relink(coarse_[turn % coarse_buckets]);
  return true;
}

}  // namespace lorentz
