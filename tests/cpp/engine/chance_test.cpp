/// No two replicas and no two seeds share a random number. The random numbers that starts, injections and
/// flights reveal are compared one by one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "engine/closed_dynamics.hpp"
#include "engine/closed_start.hpp"
#include "engine/open_dynamics.hpp"
#include "engine/open_start.hpp"
#include "engine/pair.hpp"
#include "support/collisions.hpp"

namespace chance_test {

using namespace lorentz;

using Sequence = std::vector<double>;
constexpr double unknown = 0;  // a draw that is not observable

/// One sequence for every particle or stream. chance: probability that two independent draws agree.
struct Draws {
  std::vector<Sequence> sequences;
  double chance;
};

/// Whether any number occurs in both sets of draws, which is impossible for independent continuous draws.
bool share_a_number(const Draws& a, const Draws& b) {
  const auto sorted = [](const Draws& draws) {
    Sequence all;
    for (const Sequence& sequence : draws.sequences) all.insert(all.end(), sequence.begin(), sequence.end());
    EXPECT_GT(all.size(), 500U);
    std::ranges::sort(all);
    return all;
  };
  Sequence common;
  std::ranges::set_intersection(sorted(a), sorted(b), std::back_inserter(common));
  return !common.empty();
}

/// Whether discrete draws at equal positions of equal sequences agree more often than by chance; the number
/// of agreements of independent draws is binomial.
bool agree_too_often(const Draws& a, const Draws& b) {
  double pairs = 0, equal = 0;
  for (std::size_t i = 0; i < std::min(a.sequences.size(), b.sequences.size()); ++i) {
    const Sequence &x = a.sequences[i], &y = b.sequences[i];
    for (std::size_t k = 0; k < std::min(x.size(), y.size()); ++k) {
      if (x[k] == unknown || y[k] == unknown) continue;
      pairs += 1;
      equal += x[k] == y[k] ? 1 : 0;
    }
  }
  EXPECT_GT(pairs, 1000);
  return equal - pairs * a.chance > 4 * std::sqrt(pairs * a.chance * (1 - a.chance));
}

bool share(const Draws& a, const Draws& b) {
  return a.chance == 0 ? share_a_number(a, b) : agree_too_often(a, b);
}

/// Probability that two geometric numbers agree.
double chance_of_equal_cells(double scattering_probability) {
  return scattering_probability / (2 - scattering_probability);
}

// Draws of initial states.

PhasePoint start_of(std::uint32_t cells, std::uint32_t particles_per_cell, const StreamKey& key) {
  ClosedChain chain;
  chain.cells = cells;
  chain.particles_per_cell = particles_per_cell;
  return closed_chain_start(chain, {1, 1}, false, key);
}

/// Draws of a closed start: positions of the particles, and momenta of particles and scatterers.
Draws closed_start(const StreamKey& key, const StreamKey&) {
  Sequence drawn = start_of(1000, 1, key).scatterers;
  for (const Particle& particle : start_of(1, 1000, key).particles) {
    drawn.push_back(particle.position);
    drawn.push_back(particle.velocity);
  }
  return {{drawn}, 0};
}

OpenChain open_chain(std::uint32_t cells, double scattering_probability) {
  return {.cells = cells,
          .cell_length = 1,
          .gamma = scattering_probability * cells,
          .left = {5, 100},
          .right = {5, 100}};
}

PhasePoint warm_start_of(const OpenChain& chain, const StreamKey& key) {
  return local_equilibrium_start(chain, chain.left, chain.right, 10, key);
}

Draws warm_start(const StreamKey& key, const StreamKey&) {
  const PhasePoint start = warm_start_of(open_chain(500, 1), key);
  Sequence drawn = start.scatterers;
  for (const Particle& particle : start.particles) {
    drawn.push_back(particle.position);
    drawn.push_back(std::abs(particle.velocity));
  }
  return {{drawn}, 0};
}

// Draws of the injections.

struct Injections {
  End end;
  Sequence drawn;
  void on_injection(End at, double time, double u) {
    if (at == end) drawn.insert(drawn.end(), {time, std::abs(u)});
  }
};

template <End end>
Draws injections(const StreamKey& key, const StreamKey&) {
  const OpenChain chain = open_chain(3, 1);
  OpenDynamics dynamics(chain, empty_start(chain), 200, key);
  Injections seen{end, {}};
  simulate(dynamics, 200, seen, support::nothing);
  return {{seen.drawn}, 0};
}

// Draws of the flights.

/// Cells of every flight in the order of departures. A flight with fewer than 80 cells ahead may leave the
/// chain, so its number of cells is unknown.
struct OpenFlights {
  std::int64_t places;
  Sequence cells;
  void on_flight(const Path& path) {
    const bool confined = path.rightwards() ? path.first < places - 160 : path.first > 160;
    cells.push_back(confined ? static_cast<double>(std::abs(path.last - path.first) / 2 + 1) : unknown);
  }
};

Draws open_passes(const StreamKey& key, const StreamKey& of_start) {
  const OpenChain chain = open_chain(500, 0.25);
  OpenDynamics dynamics(chain, warm_start_of(chain, of_start), 5, key);
  OpenFlights seen{chain.right_opening(), {}};
  simulate(dynamics, 5, seen, support::nothing);
  return {{seen.cells}, chance_of_equal_cells(0.25)};
}

ClosedChain closed_chain(double scattering_probability, std::string_view rule) {
  ClosedChain chain;
  chain.cells = 64;
  chain.particles_per_cell = 1;
  chain.gamma = scattering_probability * chain.cells;
  chain.rule = rule;
  return chain;
}

const ClosedChain passing = closed_chain(0.25, Elastic::properties.name),
                  turning = closed_chain(1, RandomDirection::properties.name);

bool directions_drawn(const ClosedChain& chain) { return chain.rule == RandomDirection::properties.name; }

/// Cells of every flight by particle and order, without the first flight.
struct ClosedFlights {
  const ClosedChain& chain;
  std::vector<Sequence> drawn;
  void on_flight(const Departure& flight) {
    const auto cells = static_cast<double>(flight.cells);
    drawn[flight.particle].push_back(directions_drawn(chain) ? cells : std::abs(cells));
  }
};

double chance(const ClosedChain& chain) {
  return directions_drawn(chain) ? 0.5 : chance_of_equal_cells(chain.gamma / chain.cells);
}

constexpr double duration = 800;  // some hundred one-cell flights of every particle

Draws closed_flights(const ClosedChain& chain, const StreamKey& key, const StreamKey& of_start) {
  ClosedDynamics dynamics(chain, closed_chain_start(chain, {1, 1}, false, of_start), duration, key);
  ClosedFlights seen{chain, std::vector<Sequence>(chain.particles())};
  simulate(dynamics, duration, seen, support::nothing);
  return {seen.drawn, chance(chain)};
}

Draws closed_passes(const StreamKey& key, const StreamKey& of_start) {
  return closed_flights(passing, key, of_start);
}

Draws directions(const StreamKey& key, const StreamKey& of_start) {
  return closed_flights(turning, key, of_start);
}

/// Signs of u after the collisions at every cell.
struct DirectionsAtCells {
  std::vector<Sequence> drawn;
  void on_collision(const Collision& collision) {
    drawn[collision.scatterer].push_back(collision.particle_after > 0 ? 1 : -1);
  }
};

std::vector<Sequence> directions_at_cells(const StreamKey& key, const StreamKey& of_start) {
  OpenChain chain = open_chain(20, 1);
  chain.rule = RandomDirection::properties.name;
  OpenDynamics dynamics(chain, warm_start_of(chain, of_start), 150, key);
  DirectionsAtCells seen{std::vector<Sequence>(chain.cells)};
  simulate(dynamics, 150, seen, support::nothing);
  return seen.drawn;
}

Draws open_directions(const StreamKey& key, const StreamKey& of_start) {
  return {directions_at_cells(key, of_start), 0.5};
}

/// A source of draws. key names the stream under test; of_start names the stream of the initial state.
struct Source {
  std::string name;
  Draws (*draw)(const StreamKey& key, const StreamKey& of_start);
};

void PrintTo(const Source& source, std::ostream* out) { *out << source.name; }

using Mutant = StreamKey (*)(const StreamKey&);

class Chance : public testing::TestWithParam<Source> {
 protected:
  static bool shared(
      const StreamKey& a, const StreamKey& b, Mutant mutant = [](const StreamKey& key) { return key; }) {
    const auto draw = GetParam().draw;
    return share(draw(mutant(a), a), draw(mutant(b), b));
  }
};

TEST_P(Chance, ReplicasAndSeedsShareNoDraw) {
  const StreamKey one(1, 0), other_replica(1, 1), other_seed(2, 0);
  EXPECT_FALSE(shared(one, other_replica));
  EXPECT_FALSE(shared(one, other_seed));
  EXPECT_FALSE(shared(other_replica, other_seed));
  EXPECT_TRUE(shared(one, other_replica, [](const StreamKey& key) { return StreamKey(key.seed, 0); }));
  EXPECT_TRUE(shared(one, other_seed, [](const StreamKey& key) { return StreamKey(0, key.replica); }));
}

INSTANTIATE_TEST_SUITE_P(Sources, Chance,
                         testing::Values(Source{"ClosedStart", closed_start}, Source{"WarmStart", warm_start},
                                         Source{"InjectionLeft", injections<End::left>},
                                         Source{"InjectionRight", injections<End::right>},
                                         Source{"PassesOfAnOpenChain", open_passes},
                                         Source{"PassesOfAClosedChain", closed_passes},
                                         Source{"Directions", directions},
                                         Source{"DirectionsOfAnOpenChain", open_directions}),
                         [](const auto& source) { return source.param.name; });

// Random numbers of a collision in an open chain are named by the cell and its count of collisions. Detected
// mistakes: they are named by the cell alone, the count alone, or the index of the particle, which is reused.
TEST(ChanceOfAnOpenChain, EveryCollisionOfACellHasNumbersOfItsOwn) {
  const StreamKey key(3, 2);
  const std::vector<Sequence> drawn = directions_at_cells(key, key);
  for (std::uint32_t cell = 0; cell < drawn.size(); ++cell)
    for (std::uint64_t count = 0; count < drawn[cell].size(); ++count) {
      const double expected = RandomStream(key, Purpose::collision, cell, count).uniform() > 0.5 ? 1 : -1;
      ASSERT_EQ(drawn[cell][count], expected) << cell << " " << count;
    }
  for (std::size_t cell = 1; cell < drawn.size(); ++cell)
    EXPECT_FALSE(share({{drawn[0]}, 0.5}, {{drawn[cell]}, 0.5})) << cell;
}

/// Particles of the plain trajectory of a pair without sharing.
std::vector<Particle> plain_particles(const PairDynamics& pair, double time, std::size_t size) {
  std::vector<Particle> particles(size);
  pair.for_each_diverged_particle(
      time, [&](std::uint32_t number, const Particle& plain, const Particle&) { particles[number] = plain; });
  return particles;
}

/// Draws of the flights of the plain trajectory of a pair, which has no observer: a flight ends where the
/// velocity changes. Velocities are sampled so often that no flight of one cell is missed.
Draws pair_flights(const ClosedChain& chain, const PhasePoint& start, const StreamKey& key) {
  constexpr double step = 0.05;
  PairDynamics pair(chain, start, start, duration, key, /*share=*/false);
  std::vector<Particle> last = plain_particles(pair, 0, chain.particles());
  std::vector<double> departure(last.size(), -1);  // -1: the first flight, whose departure is unknown
  std::vector<Sequence> drawn(last.size());
  for (double time = step; time < duration; time += step) {
    pair.run(time, support::nothing);
    const std::vector<Particle> now = plain_particles(pair, time, chain.particles());
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (now[i].velocity == last[i].velocity) continue;
      const double cells = std::round(last[i].velocity * (time - departure[i]));
      if (departure[i] >= 0) drawn[i].push_back(directions_drawn(chain) ? cells : std::abs(cells));
      departure[i] = time;
    }
    last = now;
  }
  return {drawn, chance(chain)};
}

TEST(ChanceOfThePulse, RelaxationAndPulseShareNoDraw) {
  const StreamKey key(1, 0);
  for (const ClosedChain& chain : {passing, turning}) {
    const PhasePoint start = closed_chain_start(chain, {1, 1}, false, key);
    ClosedDynamics relaxing(chain, start, duration, key);
    ClosedFlights seen{chain, std::vector<Sequence>(chain.particles())};
    simulate(relaxing, duration, seen, support::nothing);
    const Draws relaxation{seen.drawn, chance(chain)};

    PhasePoint relaxed = relaxing.phase_point(duration);
    EXPECT_FALSE(share(relaxation, pair_flights(chain, relaxed, key)));
    for (Particle& particle : relaxed.particles) particle.draws = 0;  // mistake: counted from 0 again
    EXPECT_TRUE(share(relaxation, pair_flights(chain, relaxed, key)));
  }
}

}  // namespace chance_test
