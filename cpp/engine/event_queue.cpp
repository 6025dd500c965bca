#include "engine/event_queue.hpp"

#include <algorithm>
#include <limits>

namespace lorentz {
namespace {

// By measurement (docs/numerics.md). Mean number of events in a bucket: few enough that lists are rarely
// longer than one, which the processor cannot predict.
constexpr double occupancy = 0.125;
// How far the piles of single turns reach, in events per particle.
constexpr double reach = 16;

std::size_t power_of_two(double at_least, std::size_t least) {
  return std::bit_ceil(std::max(least, static_cast<std::size_t>(at_least)));
}

/// Planned number of events in a turn. In a small population hardly any flight outlasts the turn. In a large
/// one almost every one does: whether it will is foretold, and the turn's flights stay in the first levels of
/// the cache. What lies in between is slower than either.
double turn_events(double particles) {
  return particles < 6000 ? std::min(8 * particles, 16384.0) : std::clamp(particles / 32, 512.0, 8192.0);
}

std::size_t bucket_count(double particles) { return power_of_two(turn_events(particles) / occupancy, 256); }

std::size_t turn_count(double particles) {
  const double turn = occupancy * static_cast<double>(bucket_count(particles));
  return power_of_two(reach * particles / turn, 64);
}

}  // namespace

EventQueue::EventQueue(const std::vector<Flight>& flights, double rate, double end_time)
    : end_time_(end_time) {
  rebuild(flights, rate, 0);
}

/// The wheel anew, for a rate of events and a population; nothing arrives before `now`.
void EventQueue::rebuild(const std::vector<Flight>& flights, double rate, double now) {
  planned_for_ = std::max<std::size_t>(flights.size(), 1);
  const auto particles = static_cast<double>(planned_for_);
  const std::size_t size = bucket_count(particles);
  lists_.assign(size, Piles::nowhere);
  occupied_.assign(size / 64, 0);
  bucket_mask_ = size - 1;
  bucket_bits_ = std::countr_zero(size);
  turn_mask_ = turn_count(particles) - 1;
  piles_.reset(frozen() + 1, flights.size());
  // More than 2^52 ticks would be finer than the clock itself.
  ticks_per_time_ = std::clamp(rate / occupancy, 1 / end_time_, 0x1p52 / end_time_);
  const std::uint64_t next_turn = (tick_of(now) >> bucket_bits_) + 1;
  turn_end_ = next_turn * size;
  piles_end_ = next_turn + turns();
  word_ = 0;
  word_bits_ = 0;
  vacant_ = Piles::nowhere;
  counted_from_ = tick_of(now);
  counted_ = 0;
  waiting_ = 0;
  for (const Flight& flight : flights) schedule(flight);
}

std::vector<Flight> EventQueue::gathered() const {
  std::vector<Flight> flights;
  flights.reserve(planned_for_);
  const auto add = [&](std::uint32_t place) { flights.push_back(piles_[place]); };
  for (std::size_t pile = 0; pile < piles_.size(); ++pile)
    if (pile != current()) piles_.for_each(pile, add);
  // The current pile has vacant places, so its flights are found by the buckets.
  for (std::size_t word = word_; word < occupied_.size(); ++word)
    for (std::uint64_t bits = word == word_ ? word_bits_ : occupied_[word]; bits != 0; bits &= bits - 1)
      for (std::uint32_t place = lists_[bucket_of(word, bits)]; place != Piles::nowhere; place = next_[place])
        add(place);
  return flights;
}

std::vector<Flight> EventQueue::flights() const {
  std::vector<Flight> by_number;
  by_number.reserve(planned_for_);
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

/// Rebuilds the wheel if it no longer fits the rate or the population; whether it did.
bool EventQueue::replan(double until) {
  double filling = 1;  // events that came, over those that were planned
  const std::uint64_t ticks = turn_end_ - counted_from_;
  if (2 * ticks > bucket_mask_) {  // otherwise, cut short by a rebuild, the turn is counted with the next
    filling = static_cast<double>(std::exchange(counted_, 0)) / (occupancy * static_cast<double>(ticks));
    counted_from_ = turn_end_;
  }
  if (filling > 0.5 && filling < 1.5 && waiting_ <= 2 * planned_for_) return false;

  const std::vector<Flight> flights = gathered();
  double now = until;
  for (const Flight& flight : flights) now = std::min(now, flight.time);
  rebuild(flights, ticks_per_time_ * occupancy * std::max(filling, 0.125), now);
  return true;
}

bool EventQueue::begin_turn(double until) {
  // Before `until` a new particle may still arrive, so a turn that begins later has to wait.
  if (waiting_ == 0 || tick_of(std::min(until, end_time_)) < turn_end_) return false;
  if (replan(until)) return true;  // a good moment, as the wheel is empty now

  const std::uint64_t turn = turn_end_ >> bucket_bits_;
  turn_end_ += bucket_mask_ + 1;
  word_ = 0;
  vacant_ = Piles::nowhere;
  if (turn + turns() / 2 == piles_end_) spread_rest();
  piles_.clear(current());
  piles_.move(turn & turn_mask_, current());
  next_.resize(std::max(next_.size(), piles_.places()));
  piles_.for_each(current(), [&](std::uint32_t place) {
    --waiting_;
    link(place, tick_of(piles_[place].time));
  });
  return true;
}

/// The piles of the turns gone by, half of all, stand for the next ones now. Were it all of them, at the end
/// of a round most flights would be beyond.
void EventQueue::spread_rest() {
  piles_end_ += turns() / 2;
  piles_.clear(current());
  piles_.move(rest(), current());
  piles_.for_each(current(), [&](std::uint32_t place) {
    const Flight flight = piles_[place];
    piles_.append(pile_of(tick_of(flight.time)), flight);
  });
}

}  // namespace lorentz
