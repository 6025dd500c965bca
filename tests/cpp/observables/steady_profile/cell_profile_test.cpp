#include "observables/steady_profile/cell_profile.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace cell_profile_test {

using namespace lorentz;

/// Collision of a scatterer, with U before and after it.
Collision hit(std::uint32_t scatterer, double time, double before, double after) {
  return {time, 0, scatterer, 0, 0, before, after};
}

/// The expected injections are 0. The window has the length 8, so that means over it are exact binary
/// fractions.
const OpenChain chain{.cells = 2, .left = {0, 1}, .right = {0, 1}};
const Window window{2, 10};
const Bins bins(4, 4);

struct CellProfileTallies : testing::Test {
  CellTallies tallies{2, bins};
  CellProfile observer{chain, window, bins};

  /// Sums of a tally over the whole window.
  std::vector<double> sums(Tally tally) const {
    TallySums sums(tallies);
    observer.record(tallies, sums);
    std::vector<double> values(sums[tally].begin(), sums[tally].end());
    for (double& value : values) value *= 8;
    return values;
  }
};

using Values = std::vector<double>;

// The first flight enters through the left opening, passes the first scatterer and reaches the second one:
// two bonds, two arrivals, two units of time in the first cell and one in the second. The second flight
// leaves from the first scatterer through the left opening. Detected mistakes: a crossing is assigned to the
// scatterer on the other side of the bond; half cells count on one side of a bond only; the directions are
// exchanged.
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

// Flights that begin before the window or end after it. Detected mistakes: they are treated as flights within
// the window, which counts what is before the window; the residence time of the whole flight counts.
TEST_F(CellProfileTallies, FlightsAtTheEndsOfTheWindow) {
  // The first flight is at the first scatterer at 1.5, at the bond at 2.5 and at the second scatterer at 3.5.
  // The second flight leaves from there to the left and is at the bond at 10.
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

// Detected mistakes: the momentum after the collision is used for the time before it; both ends share the
// histogram of one.
TEST_F(CellProfileTallies, Scatterers) {
  observer.on_collision(hit(0, 4, 1, -3));
  observer.finish({-3, 0.5}, 10);
  EXPECT_EQ(sums(tallies.temperature), (Values{2 * 1 + 6 * 9, 8 * 0.25}));
  EXPECT_EQ(sums(tallies.end_momentum), (Values{6, 0, 2, 0, 0, 0, 8, 0}));
}

// Detected mistake: injections of the right reservoir are added to those of the left one.
TEST_F(CellProfileTallies, Injections) {
  observer.on_injection(End::right, 5, -2);
  EXPECT_EQ(sums(tallies.injection), (Values{0, 0, 0, 8, 16, 16}));
}

}  // namespace cell_profile_test
