#include "observables/steady_profile/cell_profile.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace cell_profile_test {

using namespace lorentz;

/// A scatterer is hit: U before and after.
Collision hit(std::uint32_t scatterer, double time, double before, double after) {
  return {time, 0, scatterer, 0, 0, before, after};
}

/// Without injection; a window of length 8, so that sums come back as eighths.
const OpenChain chain{.cells = 2, .left = {0, 1}, .right = {0, 1}};
const Window window{2, 10};
const Bins bins(4, 4);

struct CellProfileTallies : testing::Test {
  CellTallies tallies{2, bins};
  CellProfile observer{chain, window, bins};

  /// Of the whole window.
  std::vector<double> sums(Tally tally) const {
    TallySums sums(tallies);
    observer.record(tallies, sums);
    std::vector<double> values(sums[tally].begin(), sums[tally].end());
    for (double& value : values) value *= 8;
    return values;
  }
};

using Values = std::vector<double>;

// In through the left opening, past the first scatterer, to the second one: two bonds, two arrivals, two
// units of time in the first cell and one in the second. Then out again from the first scatterer. Finds:
// behind a bond the scatterer on the other side; half cells on one side of a bond only; directions exchanged.
TEST_F(CellProfileTallies, FlightsWithinTheWindow) {
  observer.on_flight(
      {.departure = 3, .arrival = 6, .velocity = 3, .from = 0, .first = 0, .last = 3, .time_per_place = 1});
  observer.on_flight({.departure = 7,
                      .arrival = 7.5,
                      .velocity = -2,
                      .from = 1,
                      .first = 0,
                      .last = 0,
                      .time_per_place = 0.5});
  EXPECT_EQ(sums(tallies.crossings), (Values{1, 0, 0, 1, 1, 0}));
  EXPECT_EQ(sums(tallies.crossing_squares), (Values{4, 0, 0, 9, 9, 0}));
  EXPECT_EQ(sums(tallies.arrivals), (Values{0, 0, 1, 1}));
  EXPECT_EQ(sums(tallies.arriving_squares), (Values{0, 0, 9, 9}));
  EXPECT_EQ(sums(tallies.density), (Values{2.5, 1}));
}

// Finds: the first branch for these too, which counts what lies before the window; residence of the whole
// flight.
TEST_F(CellProfileTallies, FlightsAtTheEndsOfTheWindow) {
  // At the first scatterer at 1.5, at the bond at 2.5, at the second scatterer at 3.5; then from it to the
  // left, at the bond at 10.
  observer.on_flight({.departure = 0.5,
                      .arrival = 3.5,
                      .velocity = 1,
                      .from = 0,
                      .first = 0,
                      .last = 3,
                      .time_per_place = 1});
  observer.on_flight(
      {.departure = 9, .arrival = 11, .velocity = -1, .from = 3, .first = 2, .last = 1, .time_per_place = 1});
  EXPECT_EQ(sums(tallies.crossings), (Values{0, 0, 0, 0, 1, 0}));
  EXPECT_EQ(sums(tallies.arrivals), (Values{0, 0, 0, 1}));
  EXPECT_EQ(sums(tallies.density), (Values{0.5, 1 + 1}));
}

// Finds: the momentum after the collision; the histogram of one end for both.
TEST_F(CellProfileTallies, Scatterers) {
  observer.on_collision(hit(0, 4, 1, -3));
  observer.finish({-3, 0.5}, 10);
  EXPECT_EQ(sums(tallies.temperature), (Values{2 * 1 + 6 * 9, 8 * 0.25}));
  EXPECT_EQ(sums(tallies.end_momentum), (Values{6, 0, 2, 0, 0, 0, 8, 0}));
}

// Finds: the right reservoir's as the left one's.
TEST_F(CellProfileTallies, Injections) {
  observer.on_injection(End::right, 5, -2);
  EXPECT_EQ(sums(tallies.injection), (Values{0, 0, 0, 8, 16, 16}));
}

}  // namespace cell_profile_test
