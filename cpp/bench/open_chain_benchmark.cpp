/// Cost of an event of open chains: the engine, the reference simulator (binary heap), and a lower bound, the
/// same collisions, flights and injections on the same memory without a queue, particle by particle. The
/// reservoirs inject `filling` times as many particles as the default ones. items_per_second is collisions
/// per second; gamma:0 means gamma = N.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/open_dynamics.hpp"
#include "engine/open_start.hpp"
#include "measuring_time.hpp"
#include "reference/open_heap_simulator.hpp"

namespace {

using namespace lorentz;

constexpr double age = 2;  // time in which the reference simulator, which starts empty, fills its chain

OpenChain chain_of(const benchmark::State& state) {
  OpenChain chain;
  chain.cells = static_cast<std::uint32_t>(state.range(0));
  chain.cell_length = 1. / chain.cells;
  if (state.range(2) > 0) chain.gamma = static_cast<double>(state.range(2));
  for (Reservoir* reservoir : {&chain.left, &chain.right})
    reservoir->rate *= static_cast<double>(state.range(1));
  return chain;
}

/// Time of so many collisions at the mean rate, 2 nu per scattering of a crossing particle.
double time_of(double collisions, const OpenChain& chain) {
  const double scatterings_per_crossing = chain.deterministic() ? chain.cells : 1;
  return collisions / (scatterings_per_crossing * (chain.left.rate + chain.right.rate));
}

/// Counts collisions. Numbers of particles are reused, so the largest one measures the population.
struct Collisions {
  std::int64_t count = 0;
  std::uint32_t last_slot = 0;
  void on_collision(const Collision& collision) {
    ++count;
    last_slot = std::max(last_slot, collision.particle);
  }
};

void open_engine(benchmark::State& state) {
  const OpenChain chain = chain_of(state);
  const PhasePoint start = local_equilibrium_start(chain, chain.left, chain.right, age, {1, 0});
  const auto particles = static_cast<double>(start.particles.size());
  OpenDynamics dynamics(chain, start, 1e5, {1, 0});
  Collisions observer;
  double until = time_of(settling * particles, chain);
  simulate(dynamics, until, observer, [](double) {});
  observer.count = 0;
  const double step = time_of(events_per_iteration(state, 1e4, particles), chain);
  for ([[maybe_unused]] const auto iteration : state)
    simulate(dynamics, until += step, observer, [](double) {});
  state.counters["particles"] = observer.last_slot;
  state.SetItemsProcessed(observer.count);
}

void open_reference(benchmark::State& state) {
  const OpenChain chain = chain_of(state);
  reference::OpenHeapSimulator simulator(
      {chain.cells, chain.cell_length, chain.sigma, std::min<double>(chain.gamma, chain.cells),
       chain.left.rate, chain.right.rate, chain.left.temperature, chain.right.temperature, 1e9, 1, 1, 1},
      1);
  double until = age;
  simulator.run(until);
  std::int64_t collisions = 0;
  for ([[maybe_unused]] const auto iteration : state)
    collisions += static_cast<std::int64_t>(simulator.run(until += time_of(1000, chain)));
  state.SetItemsProcessed(collisions);
}

/// The particles of the engine's start. One that leaves is replaced by one that enters at the same end.
class Queueless {
 public:
  explicit Queueless(const OpenChain& chain)
      : chain_(chain),
        cells_to_scattering_(chain.gamma / chain.cells),
        injectors_{Injector(chain.left, {1, 0}, Purpose::injection_left),
                   Injector(chain.right, {1, 0}, Purpose::injection_right)} {
    const PhasePoint start = local_equilibrium_start(chain, chain.left, chain.right, age, {1, 0});
    scatterers_ = collide_.scaled(start.scatterers);
    for (const Particle& particle : start.particles)
      flights_.push_back({0, particle.velocity,
                          static_cast<std::uint32_t>(particle.position / chain.cell_length),
                          static_cast<std::uint32_t>(flights_.size())});
    std::shuffle(flights_.begin(), flights_.end(), std::mt19937(1));  // as in closed_floor
  }

  std::uint32_t particles() const { return static_cast<std::uint32_t>(flights_.size()); }

  /// Processes the next collision of a particle and the flight after it.
  template <bool stochastic>
  void advance(std::uint32_t slot, Collisions& observer) {
    Flight& flight = flights_[slot];
    const double particle = flight.velocity, scatterer = scatterers_[flight.target];
    collide_(flight.velocity, scatterers_[flight.target], flight.target);
    observer.on_collision(
        {flight.time, slot, flight.target, particle, flight.velocity, scatterer, scatterers_[flight.target]});
    for (std::int64_t from = flight.target; !fly<stochastic>(flight, from);) from = enter(flight);
  }

 private:
  /// Begins a flight at a scatterer; false if the particle leaves.
  template <bool stochastic>
  bool fly(Flight& flight, std::int64_t from) {
    std::int64_t cells = 1;
    if constexpr (stochastic) cells = cells_to_scattering_(passes_.uniform());
    const std::int64_t target = from + (flight.velocity > 0 ? cells : -cells);
    flight.time += static_cast<double>(cells) * chain_.cell_length / std::abs(flight.velocity);
    if (static_cast<std::uint64_t>(target) >= chain_.cells) [[unlikely]]
      return false;
    flight.target = static_cast<std::uint32_t>(target);
    return true;
  }

  /// Replaces the particle; returns the cell before the first one of its flight.
  std::int64_t enter(Flight& flight) {
    const bool right = flight.velocity > 0;
    const double speed = injectors_[right ? 1 : 0].take();
    flight.velocity = right ? -speed : speed;
    return right ? std::int64_t{chain_.cells} : -1;
  }

  OpenChain chain_;
  Elastic collide_{chain_.sigma};
  GeometricCells cells_to_scattering_;
  RandomStream passes_{{1, 0}, Purpose::passes, 0};
  std::array<Injector, 2> injectors_;
  std::vector<double> scatterers_;
  std::vector<Flight> flights_;
};

void open_floor(benchmark::State& state) {
  const OpenChain chain = chain_of(state);
  Queueless particles(chain);
  Collisions observer;
  std::uint32_t slot = 0;
  const auto advance = [&]<bool stochastic>(std::uint64_t events) {
    for (; events > 0; --events) {
      particles.advance<stochastic>(slot, observer);
      if (++slot == particles.particles()) slot = 0;
    }
  };
  constexpr std::uint64_t events = 10'000;
  for ([[maybe_unused]] const auto iteration : state) {
    if (chain.deterministic())
      advance.operator()<false>(events);
    else
      advance.operator()<true>(events);
  }
  benchmark::DoNotOptimize(observer.count);
  state.SetItemsProcessed(observer.count);
}

// The number of iterations is fixed, as the preparation of a full chain takes longer than they do.
void all_fillings(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"cells", "filling", "gamma"})->Iterations(100);
  benchmark->ArgsProduct({{201}, {1, 10, 100, 10'000}, {0, 1}});
}

void affordable_fillings(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"cells", "filling", "gamma"})->Iterations(50);
  benchmark->ArgsProduct({{201}, {1, 10, 100}, {0, 1}});
}

BENCHMARK(open_engine)->Apply(all_fillings);
BENCHMARK(open_reference)->Apply(affordable_fillings);
BENCHMARK(open_floor)->Apply(all_fillings);

}  // namespace
