/// The engine against the reference simulator (binary heap, every scatterer visited). items_per_second is
/// events per second; gamma:0 means gamma = N.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "engine/closed_dynamics.hpp"
#include "engine/closed_start.hpp"
#include "engine/open_dynamics.hpp"
#include "engine/open_start.hpp"
#include "reference/heap_simulator.hpp"
#include "reference/open_heap_simulator.hpp"

namespace {

using namespace lorentz;

constexpr double forever = 1e9;
constexpr std::int64_t events_per_iteration = 100'000;
NoObserver nobody;
void nothing(double) {}

/// A closed chain, and the time in which an average event of it happens.
struct Closed {
  explicit Closed(const benchmark::State& state)
      : chain{static_cast<std::uint32_t>(state.range(0)), static_cast<std::uint32_t>(state.range(1)), 1,
              0.5} {
    if (state.range(2) > 0) chain.gamma = static_cast<double>(state.range(2));
    start = closed_chain_start(chain, {}, false, {1, 0});
    interval = 1 / expected_rate(chain, start);
  }
  ClosedChain chain;
  PhasePoint start;
  double interval;
};

void closed_engine(benchmark::State& state) {
  const Closed of(state);
  ClosedDynamics dynamics(of.chain, of.start, forever, {1, 0});
  double until = 16 * of.chain.particles() * of.interval;  // until the queue has the slow flights as well
  simulate(dynamics, until, nobody, nothing);
  const std::uint64_t before = dynamics.events();
  for ([[maybe_unused]] const auto iteration : state)
    simulate(dynamics, until += events_per_iteration * of.interval, nobody, nothing);
  state.SetItemsProcessed(static_cast<std::int64_t>(dynamics.events() - before));
}

void closed_reference(benchmark::State& state) {
  const Closed of(state);
  auto simulator = reference::heap_simulator<double>(of.chain.sigma, of.chain.cell_length, of.start);
  if (!of.chain.deterministic()) simulator.scatter_with(of.chain.gamma / of.chain.cells, 1);
  reference::HeapSimulator<double>::Event event{};
  for ([[maybe_unused]] const auto iteration : state)
    for (std::int64_t left = events_per_iteration; left > 0; --left) simulator.step(forever, event);
  state.SetItemsProcessed(state.iterations() * events_per_iteration);
}

OpenChain open_chain(const benchmark::State& state) {
  OpenChain chain{.cells = 201, .cell_length = 1. / 201};
  if (state.range(0) > 0) chain.gamma = static_cast<double>(state.range(0));
  return chain;
}

void open_engine(benchmark::State& state) {
  const OpenChain chain = open_chain(state);
  OpenDynamics dynamics(chain, local_equilibrium_start(chain, chain.left, chain.right, 2, {1, 0}), forever,
                        {1, 0});
  double until = 2;
  for ([[maybe_unused]] const auto iteration : state) simulate(dynamics, until += 1, nobody, nothing);
  state.SetItemsProcessed(static_cast<std::int64_t>(dynamics.events()));
}

void open_reference(benchmark::State& state) {
  const OpenChain chain = open_chain(state);
  const auto& [left, right] = std::pair(chain.left, chain.right);
  reference::OpenHeapSimulator simulator(
      {chain.cells, chain.cell_length, chain.sigma, std::min<double>(chain.gamma, chain.cells), left.rate,
       right.rate, left.temperature, right.temperature, forever, 1, 1, 1},
      1);
  double until = 2;
  simulator.run(until);
  std::uint64_t collisions = 0;
  for ([[maybe_unused]] const auto iteration : state) collisions += simulator.run(until += 0.1);
  state.SetItemsProcessed(static_cast<std::int64_t>(collisions));
}

void chains(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"cells", "particles_per_cell", "gamma"})->Iterations(20);
  benchmark->Args({11, 20, 0})->Args({10'000, 100, 0})->Args({11, 20, 1})->Args({50, 20, 1});
}

BENCHMARK(closed_reference)->Apply(chains);
BENCHMARK(closed_engine)->Apply(chains);
BENCHMARK(open_reference)->ArgName("gamma")->Arg(0)->Arg(1)->Iterations(20);
BENCHMARK(open_engine)->ArgName("gamma")->Arg(0)->Arg(1)->Iterations(20);

}  // namespace
