#include "engine/path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace path_test {

using namespace lorentz;

/// A random flight that begins at an opening, at one of the marks 0...20, or between two of them.
Path random_path(std::mt19937_64& generator) {
  std::uniform_int_distribution<int> mark(0, 20);
  std::uniform_real_distribution<double> uniform;
  const double tau = std::exp(6 * uniform(generator) - 3), departure = 5 * uniform(generator);
  const bool rightwards = uniform(generator) < 0.5;
  const int a = mark(generator);
  int b = mark(generator);
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
    // The windows include those that begin or end exactly at marks.
    std::vector<double> edges{
        0, path.departure, path.time_at(path.first), path.time_at(path.last), path.arrival, 1e4};
    std::ranges::sort(edges);
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

}  // namespace path_test
