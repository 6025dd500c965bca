#include "engine/event_queue.hpp"

#include <algorithm>
#include <limits>

namespace lorentz {
namespace {

// By measurement (docs/numerics.md). Mean number of events in a bucket: few enough that lists are rarely
// longer than one, which the processor cannot predict.
constexpr double occupancy = 0.125;
// Events of a turn, per particle and at most: long turns send few flights through the piles, short ones keep
// their flights in the second-level cache.
constexpr double turn_per_particle = 8;
constexpr double longest_turn = 8192;
// How far the piles of single turns reach, in events per particle.
constexpr double reach = 16;

std::size_t power_of_two(double at_least, std::size_t least) {
  return std::bit_ceil(std::max(least, static_cast<std::size_t>(at_least)));
}

std::size_t bucket_count(std::size_t particles) {
  const double turn = std::min(turn_per_particle * static_cast<double>(particles), longest_turn);
  return power_of_two(turn / occupancy, 256);
}

std::size_t turn_count(std::size_t particles) {
  const double turn = occupancy * static_cast<double>(bucket_count(particles));
  return power_of_two(reach * static_cast<double>(particles) / turn, 64);
}

}  // namespace

EventQueue::EventQueue(const std::vector<Flight>& flights, double rate, double end_time)
    : end_time_(end_time) {
  rebuild(flights, rate, 0);
}

/// The wheel anew, for a rate of events and a population; nothing arrives before `now`.
void EventQueue::rebuild(const std::vector<Flight>& flights, double rate, double now) {
  const std::size_t size = bucket_count(flights.size()), turns = turn_count(flights.size());
  lists_.assign(size, Piles::nowhere);
  occupied_.assign(size / 64, 0);
  bucket_mask_ = size - 1;
  bucket_bits_ = std::countr_zero(size);
  turn_mask_ = turns - 1;
  piles_.reset(frozen() + 1, flights.size());
  // More than 2^52 ticks would be finer than the clock itself.
  ticks_per_time_ = std::clamp(rate / occupancy, 1 / end_time_, 0x1p52 / end_time_);
  const std::uint64_t next_turn = (tick_of(now) >> bucket_bits_) + 1;
  turn_end_ = next_turn * size;
  piles_end_ = next_turn + turns;
  word_ = 0;
  word_bits_ = 0;
  vacant_ = Piles::nowhere;
  taken_in_turn_ = 0;
  waiting_ = 0;
  for (const Flight& flight : flights) schedule(flight);
}

std::vector<Flight> EventQueue::gathered() const {
  std::vector<Flight> flights;
  const auto add = [&](std::uint32_t place) { flights.push_back(piles_[place]); };
  for (std::size_t pile = 0; pile < piles_.size(); ++pile)
    if (pile != current()) piles_.for_each(pile, add);
  for (std::uint32_t place : lists_)  // the current pile has vacant places
    for (; place != Piles::nowhere; place = next_[place]) add(place);
  return flights;
}

std::vector<Flight> EventQueue::flights() const {
  std::vector<Flight> by_number;
  for (const Flight& flight : gathered()) {
    while (by_number.size() <= flight.particle)
      by_number.push_back(
          {std::numeric_limits<double>::infinity(), 0, 0, static_cast<std::uint32_t>(by_number.size())});
    by_number[flight.particle] = flight;
  }
  return by_number;
}

void EventQueue::shift(double origin) {
  std::vector<Flight> flights = gathered();
  for (Flight& flight : flights) flight.time -= origin;
  end_time_ -= origin;
  rebuild(flights, ticks_per_time_ * occupancy, 0);
}

/// Its place, or nowhere if it does not arrive before `until`.
std::uint32_t EventQueue::take_first_of_list(std::size_t bucket, double until) {
  std::uint32_t* link_to_first = &lists_[bucket];
  std::uint32_t first = *link_to_first;
  for (std::uint32_t* link = &next_[first]; *link != Piles::nowhere; link = &next_[*link]) {
    const Flight &a = piles_[*link], &b = piles_[first];
    if (a.time < b.time || (a.time == b.time && a.particle < b.particle)) {
      link_to_first = link;
      first = *link;
    }
  }
  if (!(piles_[first].time < until)) return Piles::nowhere;
  *link_to_first = next_[first];
  return first;
}

bool EventQueue::begin_turn(double until) {
  // Before `until` a new particle may still arrive, so a turn that begins later has to wait.
  if (waiting_ == 0 || tick_of(std::min(until, end_time_)) < turn_end_) return false;
  // The wheel is empty now: a good moment to rebuild it when it no longer fits the rate or the population.
  const double filling =
      static_cast<double>(taken_in_turn_) / (occupancy * static_cast<double>(bucket_mask_ + 1));
  if (filling > 1.5 || filling < 0.5 || bucket_count(waiting_) - 1 > bucket_mask_ ||
      turn_count(waiting_) - 1 > turn_mask_) {
    const std::vector<Flight> flights = gathered();
    double now = until;
    for (const Flight& flight : flights) now = std::min(now, flight.time);
    rebuild(flights, ticks_per_time_ * occupancy * std::clamp(filling, 0.125, 8.0), now);
    return true;
  }

  const std::uint64_t turn = turn_end_ >> bucket_bits_;
  turn_end_ += bucket_mask_ + 1;
  word_ = 0;
  vacant_ = Piles::nowhere;
  taken_in_turn_ = 0;
  if (turn == piles_end_) spread_rest();
  piles_.clear(current());
  piles_.move(turn & turn_mask_, current());
  next_.resize(std::max(next_.size(), piles_.places()));
  piles_.for_each(current(), [&](std::uint32_t place) {
    --waiting_;
    link(place, tick_of(piles_[place].time));
  });
  return true;
}

/// All piles of turns are empty, so they stand for the next ones now.
void EventQueue::spread_rest() {
  piles_end_ += turn_mask_ + 1;
  piles_.clear(current());
  piles_.move(rest(), current());
  piles_.for_each(current(), [&](std::uint32_t place) {
    const Flight flight = piles_[place];
    piles_.append(pile_of(tick_of(flight.time)), flight);
  });
}

}  // namespace lorentz
