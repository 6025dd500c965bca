/// Cost of an event of open chains: the engine and the reference simulator (binary heap). The reservoirs
/// inject `filling` times as many particles as the default ones. items_per_second is collisions per second;
/// gamma:0 stands for gamma = N.
#include <benchmark/benchmark.h>

#include "engine/open_dynamics.hpp"
#include "engine/open_start.hpp"
#include "reference/open_heap_simulator.hpp"

namespace {

using namespace lorentz;

constexpr double age = 2;  // in which the reference simulator, which starts empty, fills its chain

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

/// Collisions, and the particles' numbers, which serve again: the largest is the population.
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
  OpenDynamics dynamics(chain, local_equilibrium_start(chain, chain.left, chain.right, age, 1, 0), 1e5, 1, 0);
  Collisions observer;
  double until = time_of(20 * chain.left.rate, chain);  // ten collisions of each particle, or more
  simulate(dynamics, until, observer, [](double) {});
  observer.count = 0;
  for ([[maybe_unused]] auto iteration : state)
    simulate(dynamics, until += time_of(1e4, chain), observer, [](double) {});
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
  for ([[maybe_unused]] auto iteration : state)
    collisions += static_cast<std::int64_t>(simulator.run(until += time_of(1000, chain)));
  state.SetItemsProcessed(collisions);
}

BENCHMARK(open_engine)
    ->ArgNames({"cells", "filling", "gamma"})
    ->Iterations(100)
    ->ArgsProduct({{201}, {1, 10, 100, 10'000}, {0, 1}});
BENCHMARK(open_reference)
    ->ArgNames({"cells", "filling", "gamma"})
    ->Iterations(50)
    ->ArgsProduct({{201}, {1, 10, 100}, {0, 1}});

}  // namespace
