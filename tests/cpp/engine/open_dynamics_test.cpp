#include "engine/open_dynamics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/open_start.hpp"
#include "engine/relaxation.hpp"
#include "support/collisions.hpp"
#include "support/rules.hpp"

namespace open_dynamics_test {

using namespace lorentz;

constexpr double infinity = std::numeric_limits<double>::infinity();

OpenChain chain_of(std::uint32_t cells, double gamma, double sigma = 0.5) {
  return {{cells, 1. / cells, sigma, gamma}, {220, 900. / 11}, {180, 1100. / 9}};
}

/// Records injections, exits and every flight.
struct Everything {
  double entered = 0, left = 0, flying = 0;  // energy; flying: of the particles that scatter again
  std::uint64_t entries = 0;
  std::vector<Path> paths;
  void on_injection(End end, double, double u) {
    EXPECT_EQ(u > 0, end == End::left);
    entered += 0.5 * u * u;
    ++entries;
  }
  void on_exit(End end, double, double u) {
    EXPECT_EQ(direction(u) > 0, end == End::right);
    left += 0.5 * u * u;
  }
  void on_flight(const Path& path) {
    if (path.last % 2 != 0) flying += 0.5 * path.velocity * path.velocity;
    paths.push_back(path);
  }
  void on_collision(const Collision& collision) {
    flying -= 0.5 * collision.particle_before * collision.particle_before;
  }
};

TEST(OpenDynamics, EnergyIsWhatEnteredAndHasNotLeft) {
  for (const RuleProperties& rule : rules::all) {
    for (const double gamma : {infinity, 1., 3., 0.}) {
      for (const double sigma : {-1., -0.9, 0., 0.5, 0.999, 1.}) {
        if (rule.name == Printed::properties.name && std::abs(sigma) == 1) continue;
        OpenChain chain = chain_of(8, gamma, sigma);
        chain.rule = support::example(rule);
        OpenDynamics dynamics(chain, empty_start(chain), 20, {3, 0});
        Everything seen;
        simulate(dynamics, 20, seen, support::nothing);
        EXPECT_GT(seen.entries, 7000U);
        double inside = seen.flying;
        for (const double U : dynamics.scatterers()) inside += 0.5 * U * U;
        EXPECT_NEAR((inside + seen.left) / seen.entered, 1, 1e-11) << rule.name << gamma << " " << sigma;
      }
    }
  }
}

/// Scatterers that change, with U before the first change.
struct Changes {
  std::map<std::uint32_t, double> before{};
  void on_scatterer(std::uint32_t cell, double U, double) { before.emplace(cell, U); }
};

// Detected mistakes: the change of a neighbour is not reported, or with U after it.
TEST(OpenDynamics, ReportsEveryChangeOfAScatterer) {
  OpenChain chain = chain_of(5, infinity);
  chain.rule = {"rotation", {0.5}};
  OpenDynamics dynamics(chain, empty_start(chain), 20, {4, 0});
  std::uint64_t both = 0;
  for (double time = 0; time < 20; time += 1e-3) {
    Changes seen;
    std::vector<double> U = dynamics.scatterers();
    simulate(dynamics, time, seen, support::nothing);
    for (const auto& [cell, before] : seen.before) EXPECT_EQ(before, U[cell]);
    for (const auto& [cell, before] : seen.before) U[cell] = dynamics.scatterers()[cell];
    EXPECT_EQ(U, dynamics.scatterers());
    both += seen.before.size() == 2 ? 1 : 0;
  }
  EXPECT_GT(both, 100U);
}

/// Every flight begins where and when the one before it ended, or at an opening.
TEST(OpenDynamics, FlightsOfAParticleJoin) {
  const OpenChain chain = chain_of(6, 2);
  OpenDynamics dynamics(chain, local_equilibrium_start(chain, chain.left, chain.right, 10, {5, 0}), 10,
                        {5, 0});
  Everything seen;
  simulate(dynamics, 10, seen, support::nothing);
  std::multiset<std::pair<double, double>> arrivals;  // time and place, where another flight begins
  std::uint64_t newcomers = 0;
  for (const Path& path : seen.paths) {
    const auto before = arrivals.find({path.departure, path.from});
    if (before != arrivals.end())
      arrivals.erase(before);
    else
      ++newcomers;
    ASSERT_GT(path.arrival, path.departure);
    const bool leaves = path.last == 0 || path.last == chain.right_opening();
    if (!leaves && path.arrival < 10) arrivals.emplace(path.arrival, static_cast<double>(path.last));
  }
  EXPECT_TRUE(arrivals.empty());
  const auto at_start = static_cast<std::uint64_t>(std::count_if(
      seen.paths.begin(), seen.paths.end(), [](const Path& path) { return path.departure == 0; }));
  EXPECT_EQ(newcomers, seen.entries + at_start);
}

/// Sums over a window: crossed marks, time spent, energy entering and leaving, collisions.
struct InWindow {
  Window window{};
  std::uint64_t marks = 0, collisions = 0;
  double square = 0, time = 0, entered = 0, left = 0;
  double first_arrival = infinity;
  void on_flight(const Path& path) {
    first_arrival = std::min(first_arrival, path.arrival);
    const Marks reached = marks_in(path, window);
    if (reached.low <= reached.high) marks += static_cast<std::uint64_t>(reached.high - reached.low + 1);
    const Stretch stretch = stretch_in(path, window);
    time += stretch.duration;
    square += path.velocity * path.velocity * stretch.duration;
  }
  void on_collision(const Collision& collision) {
    if (collision.time >= window.begin) ++collisions;
  }
  void on_injection(End, double at, double u) {
    if (at >= window.begin) entered += u * u;
  }
  void on_exit(End, double at, double u) {
    if (at >= window.begin && at < window.end) left += u * u;
  }
};

// The sums over the window are equal to the last digit, whether observed from the start or only from the
// beginning of the window on. At sigma = 0 the first particle that meets a scatterer at rest stops there for
// ever. Detected mistakes: pending flights, those of stopped particles or pending exits are not reported; all
// flights of the relaxation are reported.
TEST(OpenDynamics, AnUnobservedRelaxationChangesNothing) {
  for (const auto& [gamma, sigma] : {std::pair(infinity, 0.5), {2., 0.5}, {0., 0.5}, {infinity, 0.}}) {
    for (const double begin : {0., 1.7, 9.}) {
      const OpenChain chain = chain_of(6, gamma, sigma);
      const PhasePoint start = sigma == 0
                                   ? empty_start(chain)
                                   : local_equilibrium_start(chain, chain.left, chain.right, 10, {5, 0});
      const auto dynamics = [&] { return OpenDynamics(chain, start, 10, {5, 0}); };
      OpenDynamics watched = dynamics(), unwatched = dynamics();
      InWindow all{{begin, 10}}, part{{begin, 10}};
      simulate(watched, 10, all, support::nothing);
      relax(unwatched, begin, part, support::nothing);
      simulate(unwatched, 10, part, support::nothing);
      const auto seen = [](const InWindow& sums) {
        return std::tuple(sums.marks, sums.collisions, sums.square, sums.time, sums.entered, sums.left);
      };
      EXPECT_EQ(seen(part), seen(all)) << gamma << " " << sigma << " " << begin;
      EXPECT_GT(part.left, 0);
      EXPECT_GE(part.first_arrival, begin);
    }
  }
}

}  // namespace open_dynamics_test
