#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/closed_dynamics.hpp"
#include "engine/closed_start.hpp"
#include "reference/heap_simulator.hpp"
#include "support/collisions.hpp"

namespace simulate_against_reference_test {

using namespace lorentz;

/// Bound on the difference that rounding makes between two simulations with the same order of events.
///
/// Velocities: as long as both meet the same sequence of (particle, scatterer), they are images under
/// the same orthogonal map, which conserves the length of the error vector: rounding errors add up and
/// are never amplified. They are independent, so their squares add up. A collision adds at most 14
/// units of 2^-53 in u and in U (elastic_test.cpp), a few times the root mean square; the reference
/// simulator, whose formula is shorter, adds no more.
///
/// Times: each flight adds (cell length / |u|) |du / u| and its own roundings. Errors of times reach the
/// velocities only through the order, and the order is compared exactly. So there is no exponential
/// divergence, and slow particles have the largest errors.
class Tolerance {
 public:
  Tolerance(const ClosedChain& chain, const PhasePoint& start)
      : cell_length_(chain.cell_length), times_(chain.particles(), 0) {
    const double length = chain.cells * chain.cell_length;
    for (std::size_t i = 0; i < times_.size(); ++i)
      times_[i] = 8 * unit * (length + chain.cell_length) / std::abs(start.particles[i].velocity);
  }

  double velocity() const { return velocity_; }
  double time(std::uint32_t particle) const { return times_[particle]; }

  void add(const Collision& collision) {
    const double error =
        2 * 14 * std::sqrt(2.0) * unit * std::hypot(collision.particle_after, collision.scatterer_after);
    velocity_ = std::hypot(velocity_, error);
    const double flight = cell_length_ / std::abs(collision.particle_after);
    times_[collision.particle] +=
        flight * velocity_ / std::abs(collision.particle_after) + 4 * unit * (collision.time + flight);
  }

 private:
  static constexpr double unit = 0x1p-53;
  double cell_length_;
  double velocity_ = 0;
  std::vector<double> times_;
};

/// Compares each of the first `events` collisions. The engine stops many times in between.
template <class Real>
void compare(const ClosedChain& chain, std::size_t events, std::uint64_t seed) {
  SCOPED_TRACE(testing::Message() << "sigma " << chain.sigma << ", " << chain.cells << " cells, "
                                  << chain.particles_per_cell << " particles per cell");
  const PhasePoint start = closed_chain_start(chain, {500, 100}, false, {seed, 0});
  // The engine changes sigma by a relative amount of 1e-11 on purpose, which this comparison resolves.
  const double sigma = Elastic(chain.sigma).sigma();
  auto simulator = reference::heap_simulator<Real>(sigma, chain.cell_length, start);
  const Real root_mass = std::sqrt(simulator.scatterer_mass());
  ClosedDynamics dynamics(chain, start, 1e6, {1, 0});
  support::Recorder engine;
  for (double until = 0; engine.collisions.size() < events && until < 1e6;)
    simulate(dynamics, until += 0.01, engine, support::nothing);
  ASSERT_GE(engine.collisions.size(), events);

  Tolerance tolerance(chain, start);
  for (std::size_t k = 0; k < events; ++k) {
    const Collision& collision = engine.collisions[k];
    typename reference::HeapSimulator<Real>::Event event{};
    ASSERT_TRUE(simulator.step(1e9, event));
    ASSERT_EQ(collision.particle, event.particle) << "event " << k;
    ASSERT_EQ(collision.scatterer, event.scatterer) << "event " << k;
    ASSERT_LE(std::abs(collision.time - event.time), tolerance.time(collision.particle)) << "event " << k;
    tolerance.add(collision);
    ASSERT_LE(std::abs(collision.particle_before - event.p_before), tolerance.velocity()) << "event " << k;
    ASSERT_LE(std::abs(collision.particle_after - event.p_after), tolerance.velocity()) << "event " << k;
    ASSERT_LE(std::abs(collision.scatterer_before - event.P_before / root_mass), tolerance.velocity());
    ASSERT_LE(std::abs(collision.scatterer_after - event.P_after / root_mass), tolerance.velocity());
  }
}

const std::vector<double> sigmas = {-0.95, -0.9, -0.5, -0.3, 0, 0.1, 0.5, 0.9, 0.95};

TEST(SimulateAgainstReference, EveryCollision) {
  for (const double sigma : sigmas) {
    compare<long double>({{11, 1, sigma}, 20}, 2000, 1);
    compare<double>({{11, 1, sigma}, 20}, 2000, 2);
  }
}

// In a ring of one cell every flight ends at the scatterer where it began; in one of two cells both
// neighbours are the same scatterer. One particle and one scatterer exchange their energy back and forth.
TEST(SimulateAgainstReference, SmallestChains) {
  for (const double sigma : sigmas) {
    compare<long double>({{1, 1, sigma}, 2}, 50, 3);
    compare<long double>({{1, 0.1, sigma}, 20}, 500, 3);
    compare<long double>({{2, 1, sigma}, 3}, 200, 4);
    compare<long double>({{3, 7, sigma}, 1}, 50, 5);
    compare<long double>({{1, 1, sigma}, 1}, 10, 1);
  }
}

}  // namespace simulate_against_reference_test
