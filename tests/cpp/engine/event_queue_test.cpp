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

struct Schedule {
  std::uint32_t population;
  double end_time;
  Delay delay;
  double stretch;       // mean time between two stops
  std::size_t longest;  // number of events after which the comparison ends
};

std::vector<Flight> first_flights(const Schedule& schedule, Generator& generator) {
  std::vector<Flight> flights;
  for (std::uint32_t particle = 0; particle < schedule.population; ++particle)
    flights.push_back({schedule.delay(generator), 1, 0, particle});
  return flights;
}

/// Runs the queue and an ordered set of (time, particle) side by side, with stops in between. Stops at the
/// first difference. Returns the number of events.
std::size_t compare_with_ordered_set(const Schedule& schedule, double rate) {
  Generator generator(schedule.population);
  std::exponential_distribution<double> stretch(1 / schedule.stretch);
  const std::vector<Flight> flights = first_flights(schedule, generator);
  std::set<std::pair<double, std::uint32_t>> expected;
  const auto expect = [&](const Flight& flight) {
    if (flight.time < schedule.end_time) expected.emplace(flight.time, flight.particle);
  };
  for (const Flight& flight : flights) expect(flight);
  EventQueue queue(flights, rate, schedule.end_time);

  std::size_t events = 0;
  for (double until = 0; until < schedule.end_time && events < schedule.longest;) {
    until += stretch(generator);  // beyond the end in the last iteration
    for (Flight flight; queue.take_before(until, flight); ++events) {
      if (expected.empty() || std::pair(flight.time, flight.particle) != *expected.begin() ||
          !(flight.time < until)) {
        ADD_FAILURE() << "event " << events << ": particle " << flight.particle << " at " << flight.time;
        return events;
      }
      expected.erase(expected.begin());
      flight.time += schedule.delay(generator);
      expect(flight);
      queue.schedule(flight);
    }
    if (!expected.empty() && expected.begin()->first < until) {
      ADD_FAILURE() << "the queue stopped at " << until << " before " << expected.begin()->first;
      return events;
    }
  }
  return events;
}

/// Compares for several guesses of the rate. The delays do not depend on the guess, so the schedule is always
/// the same.
void compare_for_every_rate(const Schedule& schedule, double rate) {
  const std::size_t events = compare_with_ordered_set(schedule, rate);
  EXPECT_GT(events, schedule.population / 4);
  for (const double wrong : {1e-6, 1e-2, 1e2, 1e6})
    EXPECT_EQ(compare_with_ordered_set(schedule, wrong * rate), events) << "rate times " << wrong;
  for (const double absurd : {0.0, infinity})
    EXPECT_EQ(compare_with_ordered_set(schedule, absurd), events) << "rate " << absurd;
}

// One particle, few particles, and the number of a chain. At equal times the lower number comes first.
TEST(EventQueue, KeepsTheOrderOfArrivals) {
  for (const auto& [schedule, rate] :
       std::vector<std::pair<Schedule, double>>{{{1, 2000, heavy_tailed(1), 3, 100000}, 1},
                                                {{1, 1e6, heavy_tailed(4), 1e3, 100000}, 1},
                                                {{5, 2000, heavy_tailed(0.5), 1, 100000}, 5},
                                                {{5, 2000, heavy_tailed(2), 0.01, 100000}, 5},
                                                {{220, 100, heavy_tailed(1), 0.1, 40000}, 220},
                                                {{220, 1000, heavy_tailed(3), 10, 40000}, 220},
                                                {{5, 500, quantised, 0.5, 100000}, 5},
                                                {{220, 50, quantised, 0.3, 100000}, 220}})
    compare_for_every_rate(schedule, rate);
}

// The second population is small, because the lists of a queue that expects far too few events grow as long
// as the population.
TEST(EventQueue, KeepsTheOrderOfALargePopulation) {
  for (const double rate : {2e4, 2e10})
    EXPECT_GT(compare_with_ordered_set({20000, 40, heavy_tailed(1), 0.01, 150000}, rate), 150000U);
  compare_for_every_rate({20000, 1, heavy_tailed(1), 0.01, 150000}, 20000);
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
    EXPECT_GT(compare_with_ordered_set({220, 1e6, changing, 50, 200000}, rate), 100000U);
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
    EXPECT_GT(compare_with_ordered_set({20, 1e5, mixed, 20, 300000}, rate), 300000U);
}

TEST(EventQueue, NeverReturnsArrivalsAtOrAfterTheEnd) {
  const double end = 8;
  const double last = std::nextafter(end, 0.0);
  EventQueue queue({{end, 1, 0, 0}, {last, 1, 0, 1}, {infinity, 1, 0, 2}, {9, 1, 0, 3}, {0, 1, 0, 4}}, 1,
                   end);
  Flight flight;
  ASSERT_TRUE(queue.take_before(1, flight));
  EXPECT_EQ(flight.particle, 4U);
  flight.time = end;
  queue.schedule(flight);
  EXPECT_FALSE(queue.take_before(last, flight));  // takes only arrivals strictly before the limit
  ASSERT_TRUE(queue.take_before(end, flight));
  EXPECT_EQ(flight.particle, 1U);
  flight.time = infinity;
  queue.schedule(flight);
  for (const double until : {end, 9.0, 100.0, infinity}) EXPECT_FALSE(queue.take_before(until, flight));
  EXPECT_EQ(queue.flights()[0].time, end);  // the flight is still in the queue
}

TEST(EventQueue, IsEmptyWithoutFlights) {
  Flight flight;
  EXPECT_FALSE(EventQueue({}, 1, 1).take_before(1, flight));
}

// In a revolution with less than one event per particle almost every flight waits in a list. The expected
// rate is about right, or too low, so that the wheel is rebuilt during the run.
TEST(EventQueue, KeepsTheOrderWhereFlightsOutlastTheRevolution) {
  for (const double rate : {8e4, 8e3})
    EXPECT_GT(compare_with_ordered_set({80000, 40, heavy_tailed(1), 0.01, 300000}, rate), 300000U);
}

// Every flight that outlasts the revolution takes a new slot; free slots are reused.
TEST(EventQueue, TakesNoMoreMemoryInALongRun) {
  Generator generator(3);
  const Delay delay = heavy_tailed(1);
  const Schedule schedule{2000, 1e4, delay, 1, 0};
  EventQueue queue(first_flights(schedule, generator), 2000, schedule.end_time);
  const auto run = [&](int events) {
    for (Flight flight; events > 0 && queue.take_before(schedule.end_time, flight); --events) {
      flight.time += delay(generator);
      queue.schedule(flight);
    }
    return queue.slots();
  };
  const std::size_t slots = run(200000);
  EXPECT_LT(run(1000000), 2 * slots);
}

/// Particles enter one by one and leave after some flights, as in an open chain. The queue is read up to the
/// next entry, so a new flight may arrive before everything that the queue has already looked at.
std::size_t compare_with_entries_and_exits(double entries, double exits, const Delay& delay, double rate,
                                           double end_time) {
  Generator generator(11);
  std::exponential_distribution<double> interval(entries);
  std::bernoulli_distribution leaves(exits);
  std::set<std::pair<double, std::uint32_t>> expected;
  EventQueue queue({}, rate, end_time);
  std::size_t events = 0;
  lorentz::IdPool ids;
  for (double entry = interval(generator); entry < end_time; entry += interval(generator)) {
    for (Flight flight; queue.take_before(entry, flight); ++events) {
      if (expected.empty() || std::pair(flight.time, flight.particle) != *expected.begin()) {
        ADD_FAILURE() << "event " << events << ": particle " << flight.particle << " at " << flight.time;
        return events;
      }
      expected.erase(expected.begin());
      if (leaves(generator)) {
        ids.give_back(flight.particle);
        continue;
      }
      flight.time += delay(generator);
      if (flight.time < end_time) expected.emplace(flight.time, flight.particle);
      queue.schedule(flight);
    }
    if (!expected.empty() && expected.begin()->first < entry) {
      ADD_FAILURE() << "the queue stopped at " << entry << " before " << expected.begin()->first;
      return events;
    }
    const Flight newcomer{entry + delay(generator), 1, 0, ids.take()};
    if (newcomer.time < end_time) expected.emplace(newcomer.time, newcomer.particle);
    queue.schedule(newcomer);
  }
  return events;
}

TEST(EventQueue, LetsParticlesEnterAndLeave) {
  for (const double rate : {1e-6, 1., 1000., 1e9}) {
    EXPECT_GT(compare_with_entries_and_exits(100, 0.1, heavy_tailed(1), rate, 300), 50000U) << rate;
    EXPECT_GT(compare_with_entries_and_exits(100, 0.002, heavy_tailed(1), rate, 50), 30000U) << rate;
    EXPECT_GT(compare_with_entries_and_exits(0.01, 0.5, heavy_tailed(0.5), rate, 1e5), 500U) << rate;
    EXPECT_GT(compare_with_entries_and_exits(20, 0.1, quantised, rate, 300), 10000U) << rate;
  }
}

// The number of particles grows from few to 30000. Revolutions then contain few events per particle instead
// of many.
TEST(EventQueue, LetsThePopulationGrow) {
  for (const double rate : {1., 5000.})
    EXPECT_GT(compare_with_entries_and_exits(5000, 0, heavy_tailed(1), rate, 6), 30000U) << rate;
}

}  // namespace event_queue_test
