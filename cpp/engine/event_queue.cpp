#include "engine/event_queue.hpp"

#include <algorithm>

namespace lorentz {
namespace {

// By measurement (docs/numerics.md).
constexpr double events_per_bucket = 0.125;  // few, as a second flight in a bucket is a branch misprediction
constexpr double reach = 4;                  // of the later revolutions' lists, in events per particle

/// The branch on whether a flight outlasts the revolution is predictable if few or most flights do.
double revolution_events(double particles) {
  return particles < 6000 ? std::min(16 * particles, 16384.0) : std::min(particles / 32, 8192.0);
}

std::size_t power_of_two(double at_least, std::size_t least) {
  return std::bit_ceil(std::max(least, static_cast<std::size_t>(at_least)));
}

}  // namespace

/// A wheel for a rate of events and a population; nothing arrives before `now`.
void EventQueue::rebuild(const std::vector<Flight>& flights, double rate, double now) {
  planned_for_ = std::max<std::size_t>(flights.size(), 1);
  const auto particles = static_cast<double>(planned_for_);
  const std::size_t buckets = power_of_two(revolution_events(particles) / events_per_bucket, 256);
  buckets_.assign(buckets, none);
  occupied_.assign(buckets / 64, 0);
  bucket_mask_ = buckets - 1;
  bucket_bits_ = std::countr_zero(buckets);
  const double events = events_per_bucket * static_cast<double>(buckets);
  later_.assign(power_of_two(reach * particles / events, 16), 0);
  current_ = frozen_ = 0;
  lists_.reset(flights.size(), later_.size());
  // The clock itself resolves no more than 2^52 ticks.
  ticks_per_time_ = std::clamp(rate / events_per_bucket, 1 / end_time_, 0x1p52 / end_time_);
  const std::uint64_t first = tick_at(now * ticks_per_time_);
  revolution_end_ = static_cast<double>((first | bucket_mask_) + 1);
  // The part of the revolution that is over counts as planned.
  counted_from_ =
      taken_ - static_cast<std::uint64_t>(events_per_bucket * static_cast<double>(first & bucket_mask_));
  waiting_ = word_ = word_bits_ = 0;
  Cursor cursor(*this);
  for (const Flight& flight : flights) cursor.add(flight);
  cursor.save();
}

std::vector<Flight> EventQueue::flights() const {
  std::vector<Flight> all;
  const auto add = [&](std::uint32_t slot) { all.push_back(lists_[slot]); };
  lists_.for_each(frozen_, add);
  for (const ChunkedLists::List list : later_) lists_.for_each(list, add);
  for (const std::uint32_t head : buckets_)
    for (std::uint32_t slot = head; slot != none; slot = lists_.next(slot)) add(slot);
  std::ranges::sort(all, {}, &Flight::particle);
  return all;
}

void EventQueue::shift(double origin) {
  std::vector<Flight> all = flights();
  for (Flight& flight : all) flight.time -= origin;
  end_time_ -= origin;
  rebuild(all, ticks_per_time_ * events_per_bucket, 0);
}

/// The first flight's slot, or none if it does not arrive before `until`.
std::uint32_t EventQueue::take_first_of(std::uint32_t& bucket, double until) {
  std::uint32_t* first = &bucket;
  for (std::uint32_t* link = &lists_.next(*first); *link != none; link = &lists_.next(*link)) {
    const Flight &a = lists_[*link], &b = lists_[*first];
    // Only bitwise equal times are simultaneous; the order must not depend on a tolerance.
    if (a.time < b.time || (a.time == b.time && a.particle < b.particle)) first = link;
  }
  if (!(lists_[*first].time < until)) return none;
  return std::exchange(*first, lists_.next(*first));
}

/// False if the next revolution begins after `until`, which is not after the end. Rebuilds the wheel if the
/// rate of events is far from what was planned or the population has doubled.
bool EventQueue::begin_revolution(double until) {
  if (until * ticks_per_time_ < revolution_end_) return false;
  const double planned = events_per_bucket * static_cast<double>(bucket_mask_ + 1);
  const double ratio = static_cast<double>(taken_ - std::exchange(counted_from_, taken_)) / planned;
  if (ratio < 0.5 || ratio > 1.5 || waiting_ > 2 * planned_for_) {
    const std::vector<Flight> all = flights();
    double now = until;
    for (const Flight& flight : all) now = std::min(now, flight.time);
    rebuild(all, ticks_per_time_ * events_per_bucket * std::max(ratio, 0.125), now);
    return true;
  }
  ChunkedLists::List& due = later(revolution_end_);
  revolution_end_ += static_cast<double>(buckets_.size());
  word_ = 0;
  lists_.clear(current_);
  current_ = std::exchange(due, 0);
  Cursor cursor(*this);
  lists_.for_each(current_, [&](std::uint32_t slot) {
    const double ticks = lists_[slot].time * ticks_per_time_;
    if (ticks < revolution_end_) {
      cursor.link(slot, tick_at(ticks));
      --waiting_;
    } else {
      lists_.append(due, Flight(lists_[slot]));
      cursor.find_flights();
    }
  });
  cursor.save();
  return true;
}

}  // namespace lorentz
