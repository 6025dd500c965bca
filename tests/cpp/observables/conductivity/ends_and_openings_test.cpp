#include "observables/conductivity/ends_and_openings.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace ends_and_openings_test {

using namespace lorentz;

/// Collision of a scatterer, with U before and after it.
/// The expected injections are 0, so that nothing is subtracted from the controls. The window has length 8.
const OpenChain chain{.cells = 3, .left = {0, 1}, .right = {0, 1}};
const Window window{2, 10};

std::vector<double> recorded(const EndsAndOpenings& observer, const EndTallies& tallies, Tally tally) {
  TallySums sums(tallies);
  observer.record(tallies, sums);
  return {sums[tally].begin(), sums[tally].end()};
}

// Detected mistakes: the energy is u^2 instead of u^2/2; the energy current has no sign; a crossing of one
// opening counts fully instead of half; exits are not counted, or outside the window, too.
TEST(EndsAndOpenings, Currents) {
  const EndTallies tallies;
  EndsAndOpenings observer(chain, window);
  observer.on_injection(End::left, 2.5, 2);
  observer.on_exit(End::right, 3.5, 3);
  observer.on_exit(End::left, 3.75, -1);
  observer.on_injection(End::right, 9.5, -4);
  for (const double outside : {1.9, 10.}) observer.on_exit(End::left, outside, -2);
  EXPECT_EQ(recorded(observer, tallies, tallies.energy_current), (std::vector<double>{(1 + 2 - 4) / 8.}));
  EXPECT_EQ(recorded(observer, tallies, tallies.particle_current), (std::vector<double>{0}));
  EXPECT_EQ(recorded(observer, tallies, tallies.injection), (std::vector<double>{1, 2, 2, 1, 4, 8}));
}

// Detected mistakes: the momentum after the collision is used for the time before it; the middle scatterer is
// used in place of the last one.
TEST(EndsAndOpenings, Temperatures) {
  const EndTallies tallies;
  EndsAndOpenings observer(chain, window);
  observer.on_scatterer(0, 2, 4.5);
  observer.on_scatterer(1, 100, 5.5);
  observer.finish({4, 100, 3}, 10);
  EXPECT_EQ(recorded(observer, tallies, tallies.temperature),
            (std::vector<double>{(2.5 * 4 + 5.5 * 16) / 8, 9}));
}

// One flight passes the first scatterer and reaches the last one; another reaches the first one before the
// window. Detected mistakes: only the arrival at the end of a flight counts; arrivals before the window
// count.
TEST(EndsAndOpenings, ScatteringControl) {
  const EndTallies tallies;
  OpenChain rare = chain;
  rare.gamma = 1.5;  // half of the arriving particles are scattered
  rare.sigma = 0;    // scattering exchanges the momenta
  EndsAndOpenings observer(rare, window);
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

}  // namespace ends_and_openings_test
