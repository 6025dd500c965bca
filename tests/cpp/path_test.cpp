#include "engine/path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "statistics/histogram.hpp"
#include "statistics/range_tally.hpp"
#include "statistics/time_integral.hpp"

namespace {

using namespace lorentz;

/// A flight between two of the marks 0...20, or from an opening, or from in between.
Path random_path(std::mt19937_64& generator) {
  std::uniform_int_distribution<int> mark(0, 20);
  std::uniform_real_distribution<double> uniform;
  const double tau = std::exp(6 * uniform(generator) - 3), departure = 5 * uniform(generator);
  const bool rightwards = uniform(generator) < 0.5;
  int a = mark(generator), b = mark(generator);
  while (a == b) b = mark(generator);
  const std::int64_t low = std::min(a, b), high = std::max(a, b);
  const std::int64_t first = rightwards ? low : high, last = rightwards ? high : low;
  const double back = std::vector{0., 1., uniform(generator)}[static_cast<std::size_t>(mark(generator) % 3)];
  const double from = static_cast<double>(first) - (rightwards ? back : -back);
  const double arrival = departure + std::abs(static_cast<double>(last) - from) * tau;
  return {departure, arrival, rightwards ? 1 / tau : -1 / tau, from, first, last, tau};
}

TEST(Path, MarksAreThoseReachedInTheWindow) {
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> time(0, 20);
  for (int trial = 0; trial < 20000; ++trial) {
    const Path path = random_path(generator);
    double begin = time(generator), end = time(generator);
    if (begin > end) std::swap(begin, end);
    const Marks marks = marks_in(path, {begin, end});
    for (std::int64_t mark = 0; mark <= 20; ++mark) {
      const bool reached = path.reaches(mark) && path.time_at(mark) >= begin && path.time_at(mark) < end;
      ASSERT_EQ(mark >= marks.low && mark <= marks.high, reached) << trial << " " << mark;
    }
  }
}

TEST(Path, WindowsAddUp) {
  std::mt19937_64 generator(2);
  for (int trial = 0; trial < 2000; ++trial) {
    const Path path = random_path(generator);
    std::vector<int> reached(21, 0);
    double duration = 0;
    // Windows that also begin and end exactly at marks.
    std::vector<double> edges{
        0, path.departure, path.time_at(path.first), path.time_at(path.last), path.arrival, 1e4};
    std::sort(edges.begin(), edges.end());
    for (std::size_t k = 0; k + 1 < edges.size(); ++k) {
      const Marks marks = marks_in(path, {edges[k], edges[k + 1]});
      for (std::int64_t mark = marks.low; mark <= marks.high; ++mark)
        ++reached[static_cast<std::size_t>(mark)];
      duration += stretch_in(path, {edges[k], edges[k + 1]}).duration;
    }
    for (std::int64_t mark = 0; mark <= 20; ++mark)
      ASSERT_EQ(reached[static_cast<std::size_t>(mark)], path.reaches(mark) ? 1 : 0) << trial << " " << mark;
    EXPECT_NEAR(duration, path.arrival - path.departure, 1e-9 * path.arrival);
  }
}

// Mutant: single elements left out of the sums.
TEST(RangeTally, IsTheSumOverElements) {
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> uniform;
  RangeTally<2> tally(10);
  RangeTally<> spread(10);
  std::vector<double> plain(10, 0), overlap(10, 0);
  for (int trial = 0; trial < 500; ++trial) {
    std::ptrdiff_t first = static_cast<std::ptrdiff_t>(10 * uniform(generator));
    const std::ptrdiff_t last = trial % 5 == 0 ? first : static_cast<std::ptrdiff_t>(10 * uniform(generator));
    const double value = uniform(generator);
    tally.add(first, last, {value, -2 * value});
    for (std::ptrdiff_t i = first; i <= last; ++i) plain[static_cast<std::size_t>(i)] += value;
    double low = 10 * uniform(generator), high = 10 * uniform(generator);
    if (trial % 3 == 0) low = std::floor(low), high = std::floor(high);
    if (low > high) std::swap(low, high);
    if (trial % 7 == 0) high = low;
    if (trial % 11 == 0) low = high = 10;
    spread.spread(low, high, {value});
    for (std::size_t i = 0; i < 10; ++i) {
      const double a = std::max(low, static_cast<double>(i)), b = std::min(high, static_cast<double>(i + 1));
      if (b > a) overlap[i] += value * (b - a) / (high - low);
    }
    if (low == high) overlap[std::min<std::size_t>(static_cast<std::size_t>(low), 9)] += value;
  }
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_NEAR(tally.sums(0)[i], plain[i], 1e-11);
    EXPECT_NEAR(tally.sums(1)[i], -2 * plain[i], 1e-11);
    EXPECT_NEAR(spread.sums()[i], overlap[i], 1e-11);
  }
}

TEST(Bins, HaveAnEdgeAtZero) {
  const Bins bins(6, 3);
  EXPECT_EQ(bins.edge(3), 0);
  for (std::size_t bin = 0; bin < 6; ++bin) EXPECT_EQ(bins[bins.middles()[bin]], bin);
  EXPECT_EQ(bins[0.0], 3U);
  EXPECT_EQ(bins[-1e-300], 2U);
  for (const double outside : {3.0, -3.0, 1e300, -1e300}) EXPECT_GE(bins[outside], 6U) << outside;
}

/// The double so many steps after x.
double neighbour(double x, int steps) {
  for (; steps > 0; --steps) x = std::nextafter(x, 1e300);
  for (; steps < 0; ++steps) x = std::nextafter(x, -1e300);
  return x;
}

// The bin grows with the value, one by one, and changes within two last digits of every edge; the two halves
// mirror each other. Mutant: places rounded after half of the bins is added, which takes -1e-17 for 0.
TEST(Bins, ChangeAtTheEdges) {
  for (const double max : {3., 60., 0.7, 1e-150, 1e150}) {
    const Bins bins(100, max);
    for (std::size_t edge = 1; edge < 100; ++edge) {
      std::size_t before = edge - 1;
      for (int steps = -3; steps <= 3; ++steps) {
        const double value = neighbour(bins.edge(edge), steps);
        const std::size_t bin = bins[value];
        ASSERT_TRUE(bin == before || bin == edge) << max << " " << edge << " " << steps;
        before = bin;
        if (value != 0) {
          ASSERT_EQ(bins[-value], 99 - bin);
        }
      }
      ASSERT_EQ(bins[neighbour(bins.edge(edge), -3)], edge - 1);
      ASSERT_EQ(before, edge);
    }
    EXPECT_EQ(bins[-1e-17 * max], 49U);
    EXPECT_EQ(bins[neighbour(max, -3)], 99U);
    EXPECT_EQ(bins[neighbour(max, 3)], 100U);
  }
}

TEST(TimeIntegral, DividesAmongBlocks) {
  TimeIntegral integral(Blocks(10, 14, 4));
  integral.hold(5, 3);      // before the window
  integral.hold(2, 10.5);   // only from 10 on
  integral.hold(4, 12.25);  // over three blocks
  integral.hold(1, 99);     // beyond the end
  EXPECT_EQ(integral.sums(), (std::vector<double>{3, 4, 1.75, 1}));
}

}  // namespace
