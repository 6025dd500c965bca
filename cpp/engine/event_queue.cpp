#include "engine/event_queue.hpp"

#include <algorithm>

namespace lorentz {
namespace {

// All by measurement (docs/numerics.md).
constexpr double events_per_bucket = 0.125;  // few, as a second flight in a bucket is a branch misprediction
constexpr double reach = 4;                  // of the later revolutions' lists, in events per particle

/// Events per revolution. The branch that tells whether a flight outlasts the revolution is predictable if
/// few flights do, which a small population affords, or if most do.
double revolution_events(double particles) {
  return particles < 6000 ? std::min(8 * particles, 16384.0) : std::min(particles / 32, 8192.0);
}

std::size_t power_of_two(double at_least, std::size_t least) {
  return std::bit_ceil(std::max(least, static_cast<std::size_t>(at_least)));
}

}  // namespace

EventQueue::EventQueue(const std::vector<Flight>& flights, double rate, double end_time)
    : end_time_(end_time) {
  rebuild(flights, rate, 0);
}

/// A wheel for a rate of events and a population; nothing arrives before `now`.
void EventQueue::rebuild(const std::vector<Flight>& flights, double rate, double now) {
  planned_for_ = std::max<std::size_t>(flights.size(), 1);
  const auto particles = static_cast<double>(planned_for_);
  const std::size_t buckets = power_of_two(revolution_events(particles) / events_per_bucket, 256);
  const double events = events_per_bucket * static_cast<double>(buckets);
  const std::size_t later_lists = power_of_two(reach * particles / events, 16);
  buckets_.assign(buckets, none);
  occupied_.assign(buckets / 64, 0);
  bucket_mask_ = buckets - 1;
  bucket_bits_ = std::countr_zero(buckets);
  list_mask_ = later_lists - 1;
  lists_.reset(later_lists + 2, flights.size());
  next_.clear();
  // The clock itself resolves no more than 2^52 ticks.
  ticks_per_time_ = std::clamp(rate / events_per_bucket, 1 / end_time_, 0x1p52 / end_time_);
  waiting_ = 0;
  counted_ = 0;
  counted_from_ = tick_of(now);
  revolution_end_ = ((counted_from_ >> bucket_bits_) + 1) << bucket_bits_;
  word_ = 0;
  word_bits_ = 0;
  vacant_ = none;
  for (const Flight& flight : flights) schedule(flight);
}

std::vector<Flight> EventQueue::flights() const {
  std::vector<Flight> all;
  const auto add = [&](std::uint32_t place) { all.push_back(lists_[place]); };
  for (std::size_t list = 0; list < lists_.lists(); ++list)
    if (list != current()) lists_.for_each(list, add);
  // The current list has vacant places, so its flights are found by the buckets.
  for (const std::uint32_t head : buckets_)
    for (std::uint32_t place = head; place != none; place = next_[place]) add(place);
  std::ranges::sort(all, {}, &Flight::particle);
  return all;
}

void EventQueue::shift(double origin) {
  std::vector<Flight> all = flights();
  for (Flight& flight : all) flight.time -= origin;
  end_time_ -= origin;
  rebuild(all, ticks_per_time_ * events_per_bucket, 0);
}

void EventQueue::grow() { next_.resize(lists_.places()); }

/// The first flight's place, or none if it does not arrive before `until`.
std::uint32_t EventQueue::take_first_of(std::size_t bucket, double until) {
  std::uint32_t* first = &buckets_[bucket];
  for (std::uint32_t* link = &next_[*first]; *link != none; link = &next_[*link]) {
    const Flight &a = lists_[*link], &b = lists_[*first];
    if (a.time < b.time || (a.time == b.time && a.particle < b.particle)) first = link;
  }
  const std::uint32_t place = *first;
  if (!(lists_[place].time < until)) return none;
  *first = next_[place];
  return place;
}

/// Rebuilds the wheel, between revolutions, if the rate of events is far from what was planned or the
/// population has doubled; whether it did. If a rebuild has left less than half of a revolution, it is
/// counted with the next.
bool EventQueue::adapt(double until) {
  double ratio = 1;  // of the number of events to the planned one
  const std::uint64_t ticks = revolution_end_ - counted_from_;
  if (2 * ticks > bucket_mask_) {
    ratio =
        static_cast<double>(std::exchange(counted_, 0)) / (events_per_bucket * static_cast<double>(ticks));
    counted_from_ = revolution_end_;
  }
  if (ratio > 0.5 && ratio < 1.5 && waiting_ <= 2 * planned_for_) return false;
  const std::vector<Flight> all = flights();
  double now = until;
  for (const Flight& flight : all) now = std::min(now, flight.time);
  rebuild(all, ticks_per_time_ * events_per_bucket * std::max(ratio, 0.125), now);
  return true;
}

/// False if the next revolution begins after `until` or after the end.
bool EventQueue::begin_revolution(double until) {
  until = std::min(until, end_time_);
  if (tick_of(until) < revolution_end_) return false;
  if (adapt(until)) return true;
  const std::size_t due = list_of(revolution_end_);
  revolution_end_ += bucket_mask_ + 1;
  word_ = 0;
  vacant_ = none;
  lists_.clear(current());
  lists_.move(due, current());
  if (next_.size() < lists_.places()) grow();
  lists_.for_each(current(), [&](std::uint32_t place) {
    const std::uint64_t tick = tick_of(lists_[place].time);
    if (tick < revolution_end_) {
      link(place, tick);
      --waiting_;
    } else {
      lists_.append(due, Flight(lists_[place]));
    }
  });
  return true;
}

}  // namespace lorentz
