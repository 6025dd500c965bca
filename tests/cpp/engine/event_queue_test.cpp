#include "engine/event_queue.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "engine/id_pool.hpp"

namespace event_queue_test {

using lorentz::EventQueue;
using lorentz::Flight;

constexpr double infinity = std::numeric_limits<double>::infinity();

using Generator = std::mt19937_64;
using Delay = std::function<double(Generator&)>;

/// Duration of a flight: 1/|g|^power with g normal. Its mean does not exist for power >= 1, as for flights at
/// the velocities of a chain.
Delay heavy_tailed(double power) {
  return [power](Generator& generator) {
    return std::pow(std::abs(std::normal_distribution<double>()(generator)), -power);
  };
}

/// Durations with few different values, often 0, so that many arrivals have equal times.
double quantised(Generator& generator) {
  return 0.25 * static_cast<double>(std::uniform_int_distribution<int>(0, 8)(generator));
}

/// Flights of particles that are there at the beginning, or enter one by one; after a flight a particle may
/// leave.
struct Schedule {
  std::uint32_t population;
  double end_time;
  Delay delay;
  double interval;                // mean time between two stops, at which particles enter
  std::size_t longest = 100'000;  // number of events after which the comparison ends
  bool entering = false;
  double exits = 0;  // probability that at an event a particle leaves
};

/// Runs the queue and an ordered set of (time, particle) side by side, with stops in between: a particle that
/// enters may arrive before everything that the queue has already looked at. Ends at the first difference.
/// Returns the number of events.
std::size_t compare_with_ordered_set(const Schedule& schedule, double rate) {
  Generator generator(schedule.population);
  std::exponential_distribution<double> interval(1 / schedule.interval);
  std::bernoulli_distribution leaves(schedule.exits);
  std::set<std::pair<double, std::uint32_t>> expected;
  const auto expect = [&](const Flight& flight) {
    if (flight.time < schedule.end_time) expected.emplace(flight.time, flight.particle);
  };
  lorentz::IdPool ids;
  std::vector<Flight> first;
  for (std::uint32_t count = 0; count < schedule.population; ++count)
    expect(first.emplace_back(Flight{schedule.delay(generator), 1, 0, ids.take()}));
  EventQueue queue(first, rate, schedule.end_time);
  EventQueue::Cursor cursor(queue);

  std::size_t events = 0;
  for (double until = 0; until < schedule.end_time && events < schedule.longest;) {
    until += interval(generator);  // beyond the end in the last iteration
    bool failed = false;
    const auto take = [&](Flight flight, EventQueue::Cursor&) {
      ++events;
      if (failed) return;
      if (expected.empty() || std::pair(flight.time, flight.particle) != *expected.begin() ||
          !(flight.time < until)) {
        ADD_FAILURE() << "event " << events << ": particle " << flight.particle << " at " << flight.time;
        failed = true;
        return;
      }
      expected.erase(expected.begin());
      if (schedule.exits > 0 && leaves(generator)) {
        ids.give_back(flight.particle);
        return;
      }
      flight.time += schedule.delay(generator);
      expect(flight);
      if (flight.particle % 2 == 0)
        cursor.reschedule<true>(flight);
      else
        cursor.reschedule<false>(flight);
    };
    cursor.take_before(until, take, [](double) {});
    if (failed) return events;
    if (!expected.empty() && expected.begin()->first < until) {
      ADD_FAILURE() << "the queue stopped at " << until << " before " << expected.begin()->first;
      return events;
    }
    if (!schedule.entering || !(until < schedule.end_time)) continue;
    const Flight newcomer{until + schedule.delay(generator), 1, 0, ids.take()};
    expect(newcomer);
    cursor.add(newcomer);
  }
  return events;
}

/// Rates, expected by the queue, that are about right, too low and too high, and absurd. The delays do not
/// depend on them, so the schedule is always the same.
void compare_for_every_rate(const Schedule& schedule, double rate) {
  const std::size_t events = compare_with_ordered_set(schedule, rate);
  EXPECT_GT(events, schedule.entering ? 500 : schedule.population / 4);
  for (const double other : {1e-6 * rate, 1e-2 * rate, 1e2 * rate, 1e6 * rate, 0., infinity})
    EXPECT_EQ(compare_with_ordered_set(schedule, other), events) << "rate " << other;
}

// One particle, few particles, and the number of a chain. At equal times the lower number comes first. The
// last population is small, because the lists of a queue that expects far too few events grow as long as it.
TEST(EventQueue, KeepsTheOrderOfArrivals) {
  compare_for_every_rate({1, 2000, heavy_tailed(1), 3}, 1);
  compare_for_every_rate({1, 1e6, heavy_tailed(4), 1e3}, 1);
  compare_for_every_rate({5, 2000, heavy_tailed(0.5), 1}, 5);
  compare_for_every_rate({5, 2000, heavy_tailed(2), 0.01}, 5);
  compare_for_every_rate({220, 100, heavy_tailed(1), 0.1, 40'000}, 220);
  compare_for_every_rate({220, 1000, heavy_tailed(3), 10, 40'000}, 220);
  compare_for_every_rate({5, 500, quantised, 0.5}, 5);
  compare_for_every_rate({220, 50, quantised, 0.3}, 220);
  compare_for_every_rate({20'000, 1, heavy_tailed(1), 0.01}, 20'000);
}

// Detected by these alone: in a revolution with less than one event per particle almost every flight waits in
// a list; the wheel is rebuilt during the run where the expected rate is too low.
TEST(EventQueue, KeepsTheOrderOfALargePopulation) {
  for (const double rate : {8e4, 8e3, 8e10})
    EXPECT_GE(compare_with_ordered_set({80'000, 40, heavy_tailed(1), 0.01, 300'000}, rate), 300'000U);
}

// The rate changes by orders of magnitude up and down, and the width of the bins has to follow.
TEST(EventQueue, KeepsTheOrderWhileTheRateChanges) {
  double factor = 1;
  const auto changing = [&factor](Generator& generator) {
    factor = std::bernoulli_distribution(1e-3)(generator) ? 1000 / factor : factor;
    return factor * std::exponential_distribution<double>()(generator);
  };
  for (const double rate : {220.0, 0.22, 220000.0}) {
    factor = 1;
    EXPECT_GE(compare_with_ordered_set({220, 1e6, changing, 50}, rate), 100'000U);
  }
}

// At a steady rate the width of the bins stays constant. Some flights last longer than a revolution of all
// lists, and return to their list until they are due.
TEST(EventQueue, KeepsTheOrderOfFlightsBeyondTheLists) {
  const auto mixed = [](Generator& generator) {
    if (std::bernoulli_distribution(1e-3)(generator))
      return std::uniform_real_distribution<double>(0, 4000)(generator);
    return std::exponential_distribution<double>()(generator);
  };
  for (const double rate : {7.0, 0.7, 70.0})
    EXPECT_GE(compare_with_ordered_set({20, 1e5, mixed, 20, 300'000}, rate), 300'000U);
}

// As in an open chain. The last population grows from few to 30000, so that revolutions contain few events
// per particle instead of many.
TEST(EventQueue, LetsParticlesEnterAndLeave) {
  constexpr bool entering = true;
  compare_for_every_rate({0, 100, heavy_tailed(1), 0.01, 50'000, entering, 0.1}, 1);
  compare_for_every_rate({0, 50, heavy_tailed(1), 0.01, 50'000, entering, 0.002}, 1000);
  compare_for_every_rate({0, 1e5, heavy_tailed(0.5), 100, 50'000, entering, 0.5}, 1);
  compare_for_every_rate({0, 300, quantised, 0.05, 50'000, entering, 0.1}, 1);
  for (const double rate : {1., 5000.})
    EXPECT_GE(compare_with_ordered_set({0, 6, heavy_tailed(1), 2e-4, 200'000, entering}, rate), 30'000U);
}

// Every flight that outlasts the revolution takes a new slot; free slots are reused.
TEST(EventQueue, TakesNoMoreMemoryInALongRun) {
  Generator generator(3);
  const Delay delay = heavy_tailed(1);
  std::vector<Flight> first;
  for (std::uint32_t particle = 0; particle < 2000; ++particle)
    first.push_back({delay(generator), 1, 0, particle});
  EventQueue queue(first, 2000, 1e4);
  EventQueue::Cursor cursor(queue);
  const auto slots_after = [&](std::uint64_t events) {
    for (double until = 0; cursor.taken() < events; until += 1) {
      cursor.take_before(
          until,
          [&](Flight flight, EventQueue::Cursor&) {
            flight.time += delay(generator);
            cursor.reschedule<true>(flight);
          },
          [](double) {});
    }
    return queue.slots();
  };
  const std::size_t slots = slots_after(200000);
  EXPECT_LT(slots_after(1200000), 2 * slots);
}

}  // namespace event_queue_test
