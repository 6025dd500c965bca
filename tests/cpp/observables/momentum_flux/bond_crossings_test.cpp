#include "observables/momentum_flux/bond_crossings.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace bond_crossings_test {

using namespace lorentz;
using Values = std::vector<double>;

const OpenChain chain{{.cells = 2, .cell_length = 1. / 30}, {3, 2}, {0, 1}};
const Window window{2, 10};
const Bins bins(4, 4);

Values sums(const BondCrossings& observer, const BondTallies& tallies, Tally tally) {
  TallySums sums(tallies);
  observer.record(tallies, sums);
  Values values(sums[tally].begin(), sums[tally].end());
  for (double& value : values) value *= 8;
  return values;
}

/// A flight from a position to the marks first, ..., last; positions in half cells, of which it crosses one
/// per time.
Path flight(double departure, double arrival, double velocity, double from, std::int64_t first,
            std::int64_t last) {
  return {departure, arrival, velocity, from, first, last, 1};
}

// One flight to the right crosses two bonds in the bin [0, 2); one to the left crosses the first bond in [-4,
// -2); the momentum of a third one is outside of all bins. Detected mistakes: bonds are counted from the
// scatterers on; the halves p < 0 and p > 0 are exchanged; arrays have the bins as first dimension; p^3 is
// summed in place of p^4.
TEST(BondCrossings, ByMomentumAndDirection) {
  const BondTallies tallies(2, bins);
  BondCrossings observer(chain, window, bins);
  observer.on_flight(flight(3, 6, 1, 0, 0, 3));
  observer.on_flight(flight(5, 6, -2.5, 1, 0, 0));
  observer.on_flight(flight(5, 6, 5, 3, 4, 4));
  EXPECT_EQ(sums(observer, tallies, tallies.crossings), (Values{1, 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0}));
  EXPECT_EQ(sums(observer, tallies, tallies.sums[0]), (Values{1, 0, 0, 1, 1, 1}));
  EXPECT_EQ(sums(observer, tallies, tallies.sums[1]), (Values{6.25, 0, 0, 1, 1, 25}));
  EXPECT_EQ(sums(observer, tallies, tallies.sums[2]), (Values{39.0625, 0, 0, 1, 1, 625}));
}

// Detected mistake: flights count as a whole, which includes bond 0, reached at 1, and bond 1, reached at 10.
TEST(BondCrossings, WithinTheWindow) {
  const BondTallies tallies(2, bins);
  BondCrossings observer(chain, window, bins);
  observer.on_flight(flight(1, 4, 1, 0, 0, 3));
  observer.on_flight(flight(9, 11, 1, 1, 2, 3));
  EXPECT_EQ(sums(observer, tallies, tallies.sums[0]), (Values{0, 0, 0, 0, 1, 0}));
}

}  // namespace bond_crossings_test
