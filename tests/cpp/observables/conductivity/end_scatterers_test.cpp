#include "observables/conductivity/end_scatterers.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace end_scatterers_test {

using namespace lorentz;

const OpenChain chain{{.cells = 3, .cell_length = 1. / 30}, {0, 1}, {0, 1}};
const Window window{2, 10};

std::vector<double> recorded(const EndScatterers& observer, const EndTallies& tallies, Tally tally) {
  TallySums sums(tallies);
  observer.record(tallies, WindowHalves(chain, window), sums);
  return {sums[tally].begin(), sums[tally].end()};
}

// One flight passes the first scatterer and reaches the last one; another reaches the first one before the
// window. Detected mistakes: only the arrival at the end of a flight counts; arrivals before the window
// count.
TEST(EndScatterers, ScatteringControl) {
  const EndTallies tallies;
  OpenChain rare = chain;
  rare.gamma = 1.5;  // half of the arriving particles are scattered
  rare.sigma = 0;    // scattering exchanges the momenta
  EndScatterers observer(rare, window);
  observer.on_flight({.departure = 3,
                      .arrival = 5.5,
                      .velocity = 2,
                      .from = 0,
                      .first = 0,
                      .last = 5,
                      .time_per_half_cell = 0.5});
  observer.on_flight({.departure = 1,
                      .arrival = 1.5,
                      .velocity = 7,
                      .from = 0,
                      .first = 0,
                      .last = 1,
                      .time_per_half_cell = 0.5});
  observer.finish({1, 0, 3}, 10);
  // The particle passed the first scatterer at 3.5, which gives -1/2 (4 - 1). The last scatterer scattered it
  // at 5.5, which gives +1/2 (4 - 9).
  EXPECT_EQ(recorded(observer, tallies, tallies.scattering), (std::vector<double>{-1.5, -2.5}));
}

}  // namespace end_scatterers_test
