#include "engine/closed_dynamics.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <utility>
#include <vector>

#include "engine/closed_start.hpp"
#include "engine/open_dynamics.hpp"
#include "engine/open_start.hpp"
#include "support/collisions.hpp"

namespace closed_dynamics_test {

using namespace lorentz;
using namespace support;

// A rotation is reported with the side of the neighbour that it changed, on the ring, too.
TEST(Simulate, ReportsTheNeighbourThatARuleChanges) {
  const ClosedChain chain{{.cells = 4, .rule = {"rotation", {1}}}, 1};
  int left = 0;
  for (const std::uint32_t seed : {0U, 1U, 2U, 3U, 4U, 5U, 6U, 7U})
    for (const std::uint32_t cell : {0U, 3U}) {
      const PhasePoint start{{{cell + 0.25, 1}, {0.1, 0}, {1.1, 0}, {2.1, 0}}, {0, 0, 0, 0}};
      ClosedDynamics dynamics(chain, start, 1, {1, seed});
      Recorder recorder;
      simulate(dynamics, 0.3, recorder, nothing);
      ASSERT_EQ(recorder.collisions.size(), 1U);
      const int side = recorder.collisions.front().neighbour;
      const std::vector<double> scatterers = dynamics.phase_point(0.3).scatterers;
      EXPECT_NE(scatterers[(cell + 4 + side) % 4], 0) << seed;
      EXPECT_EQ(scatterers[(cell + 4 - side) % 4], 0) << seed;
      left += side < 0;
    }
  EXPECT_GT(left, 0);
  EXPECT_LT(left, 16);
}

// A heartbeat may wait for the end of a revolution. More of them would make the threads of small chains wait
// for each other. At gamma = 0 an open chain has injections only.
TEST(Simulate, HeartbeatsComeEvery65536EventsAndMayStopTheRun) {
  NoObserver nobody;
  const auto check = [&](auto& dynamics, double end) {
    std::uint64_t events = 0, beats = 0;
    double time = 0;
    simulate(dynamics, end, nobody, [&](double now) {
      const std::uint64_t since = dynamics.events() - std::exchange(events, dynamics.events());
      EXPECT_GE(since, 65536U);
      EXPECT_LT(since, 2 * 65536U);
      EXPECT_GT(now, std::exchange(time, now));
      EXPECT_LE(now, end);
      ++beats;
    });
    EXPECT_GE(beats, 4U);
    const auto stop = [](double) { throw std::runtime_error("stop"); };
    EXPECT_THROW(simulate(dynamics, 2 * end, nobody, stop), std::runtime_error);
  };
  for (const std::uint32_t cells : {1U, 11U}) {
    const ClosedChain chain{{.cells = cells}, cells};
    const double end = 8e5 / cells / cells;
    ClosedDynamics dynamics(chain, closed_chain_start(chain, {}, false, {5, 0}), 2 * end, {1, 0});
    check(dynamics, end);
  }
  for (const double gamma : {0., 4.}) {
    const OpenChain chain{{.cells = 4, .cell_length = 0.25, .gamma = gamma}};
    OpenDynamics dynamics(chain, empty_start(chain), 4000, {1, 0});
    check(dynamics, 2000);
  }
}

}  // namespace closed_dynamics_test
