/// Cost of an event in the engine and in the reference simulator (binary heap), side by side in one
/// process. items_per_second is events per second.
#include <benchmark/benchmark.h>

#include "engine/closed_dynamics.hpp"
#include "engine/closed_start.hpp"
#include "reference/heap_simulator.hpp"

namespace {

using namespace lorentz;

/// The least that an observable does, the same for both simulators.
struct Persistent {
  std::uint64_t count = 0;
  void on_collision(const Collision& collision) {
    count += (collision.particle_before > 0) == (collision.particle_after > 0) ? 1 : 0;
  }
};

ClosedChain chain_of(const benchmark::State& state) {
  return {static_cast<std::uint32_t>(state.range(0)), static_cast<std::uint32_t>(state.range(1)), 1, 0.5};
}

/// Time in which every particle scatters about twenty times: an iteration of the benchmark.
constexpr double stretch = 2;

/// Both simulators run until the same time, in stretches; iterations beyond it would find nothing to do.
constexpr double end_time = 1e6;

void engine(benchmark::State& state) {
  const ClosedChain chain = chain_of(state);
  ClosedDynamics dynamics(chain, closed_chain_start(chain, {}, false, 1, 0), end_time);
  Persistent observer;
  double until = 10;
  simulate(dynamics, until, observer, [](double) {});
  const std::uint64_t before = dynamics.events();
  for ([[maybe_unused]] auto iteration : state) simulate(dynamics, until += stretch, observer, [](double) {});
  benchmark::DoNotOptimize(observer.count);
  state.SetItemsProcessed(static_cast<std::int64_t>(dynamics.events() - before));
}

void reference_heap(benchmark::State& state) {
  const ClosedChain chain = chain_of(state);
  auto simulator = reference::heap_simulator<double>(chain.sigma, chain.cell_length,
                                                     closed_chain_start(chain, {}, false, 1, 0));
  reference::HeapSimulator<double>::Event event{};
  double until = 10;
  while (simulator.step(until, event)) {
  }
  std::int64_t events = 0;
  std::uint64_t persistent = 0;
  for ([[maybe_unused]] auto iteration : state) {
    until += stretch;
    while (simulator.step(until, event)) {
      ++events;
      persistent += (event.p_before > 0) == (event.p_after > 0) ? 1 : 0;
    }
  }
  benchmark::DoNotOptimize(persistent);
  state.SetItemsProcessed(events);
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"cells", "particles_per_cell"})->Args({11, 20})->Args({1000, 50});
}

BENCHMARK(engine)->Apply(sizes);
BENCHMARK(reference_heap)->Apply(sizes);

}  // namespace
