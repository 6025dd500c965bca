#include "engine/event_queue.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace lorentz {
namespace {

// By measurement (docs/numerics.md). Mean number of events in a bucket: few enough that lists are rarely
// longer than one, which the processor cannot predict.
constexpr double occupancy = 0.125;
// Events of a turn, per particle and at most: long turns send few flights through the coarse buckets, short
// ones keep their flights in the second-level cache.
constexpr double turn_per_particle = 8;
constexpr double longest_turn = 8192;
// How far the coarse buckets reach, in events per particle.
constexpr double reach = 64;

std::size_t power_of_two(double at_least, std::size_t least) {
  return std::bit_ceil(std::max(least, static_cast<std::size_t>(at_least)));
}

std::size_t bucket_count(std::size_t particles) {
  const double turn = std::min(turn_per_particle * static_cast<double>(particles), longest_turn);
  return power_of_two(turn / occupancy, 256);
}

std::size_t coarse_count(std::size_t particles) {
  const double turn = occupancy * static_cast<double>(bucket_count(particles));
  return power_of_two(reach * static_cast<double>(particles) / turn, 64);
}

}  // namespace

EventQueue::EventQueue(const std::vector<Flight>& flights, double rate, double end_time)
    : flights_(flights.begin(), flights.end()), end_time_(end_time) {
  rebuild(rate, 0);
}

/// The wheel anew, for a rate of events and the present population; nothing arrives before `now`.
void EventQueue::rebuild(double rate, double now) {
  const std::size_t size = bucket_count(flights_.size()), coarse = coarse_count(flights_.size());
  lists_.assign(size + (coarse + 1) * lanes, none);
  occupied_.assign(size / 64, 0);
  bucket_mask_ = size - 1;
  bucket_bits_ = std::countr_zero(size);
  coarse_mask_ = coarse - 1;
  // More than 2^52 ticks would be finer than the clock itself.
  ticks_per_time_ = std::clamp(rate / occupancy, 1 / end_time_, 0x1p52 / end_time_);
  const std::uint64_t next_turn = (tick_of(now) >> bucket_bits_) + 1;
  turn_end_ = next_turn * size;
  coarse_end_ = next_turn + coarse;
  word_ = 0;
  word_bits_ = 0;
  taken_in_turn_ = 0;
  waiting_ = 0;
  for (std::uint32_t slot = 0; slot < flights_.size(); ++slot) schedule(slot);
}

void EventQueue::shift(double origin) {
  for (Flight& flight : flights_) flight.time -= origin;
  end_time_ -= origin;
  rebuild(ticks_per_time_ * occupancy, 0);
}

std::uint32_t EventQueue::take_first_of_list(std::size_t bucket, double until) {
  std::uint32_t* link_to_first = &lists_[bucket];
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

/// Schedules the flights of a coarse bucket again.
void EventQueue::relink(std::size_t first_list) {
  std::array<std::uint32_t, lanes> heads{};
  for (std::size_t lane = 0; lane < lanes; ++lane)
    heads[lane] = std::exchange(lists_[first_list + lane], none);
  for (bool more = true; std::exchange(more, false);) {
    for (std::uint32_t& slot : heads) {
      if (slot == none) continue;
      const std::uint32_t next = flights_[slot].next;
      __builtin_prefetch(&flights_[next == none ? slot : next], 1);
      --waiting_;
      schedule(slot);
      slot = next;
      more = true;
    }
  }
}

bool EventQueue::begin_turn(double until) {
  // Before `until` a new particle may still arrive, so a turn that begins later has to wait.
  if (waiting_ == 0 || tick_of(std::min(until, end_time_)) < turn_end_) return false;
  // The wheel is empty now: a good moment to rebuild it when it no longer fits the rate or the population.
  const double filling =
      static_cast<double>(taken_in_turn_) / (occupancy * static_cast<double>(bucket_mask_ + 1));
  if (filling > 1.5 || filling < 0.5 || bucket_count(flights_.size()) - 1 > bucket_mask_ ||
      coarse_count(flights_.size()) - 1 > coarse_mask_) {
    double now = until;
    for (const Flight& flight : flights_) now = std::min(now, flight.time);
    rebuild(ticks_per_time_ * occupancy * std::clamp(filling, 0.125, 8.0), now);
    return true;
  }

  const std::uint64_t turn = turn_end_ >> bucket_bits_;
  turn_end_ += bucket_mask_ + 1;
  word_ = 0;
  taken_in_turn_ = 0;
  if (turn == coarse_end_) {
    coarse_end_ += coarse_mask_ + 1;
    relink(lists_of(coarse_end_));  // the rest
  }
  relink(lists_of(turn));
  return true;
}

}  // namespace lorentz
