/// Cost of an event of closed chains: the engine, the reference simulator (binary heap), and a lower bound,
/// the same collisions and flights on the same memory without a queue, particle by particle. Also short runs
/// with and without freezing of late arrivals. items_per_second is events per second; gamma:0 is gamma = N.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <random>

#include "engine/closed_dynamics.hpp"
#include "engine/closed_start.hpp"
#include "engine/flights.hpp"
#include "measuring_time.hpp"
#include "reference/heap_simulator.hpp"

namespace {

using namespace lorentz;

/// A minimal observable, the same in all benchmarks.
struct Persistent {
  std::uint64_t count = 0;
  void add(double before, double after) { count += (before > 0) == (after > 0) ? 1 : 0; }
  void on_collision(const Collision& collision) { add(collision.particle_before, collision.particle_after); }
};

struct Case {
  explicit Case(benchmark::State& state)
      : chain{static_cast<std::uint32_t>(state.range(0)), static_cast<std::uint32_t>(state.range(1)), 1,
              0.5} {
    if (state.range(2) > 0) chain.gamma = static_cast<double>(state.range(2));
    start = closed_chain_start(chain, {}, false, {1, 0});
    rate = expected_rate(chain, start);
    state.counters["particles"] = chain.particles();
  }

  ClosedChain chain;
  PhasePoint start;
  double rate;  // of events
};

constexpr double end_time = 1e5;  // beyond all iterations

void closed_engine(benchmark::State& state) {
  const Case of(state);
  ClosedDynamics dynamics(of.chain, of.start, end_time, {1, 0});
  Persistent observer;
  double until = settling * of.chain.particles() / of.rate;
  simulate(dynamics, until, observer, [](double) {});
  const std::uint64_t before = dynamics.events();
  const double step = events_per_iteration(state, 1e5, of.chain.particles()) / of.rate;
  for ([[maybe_unused]] const auto iteration : state)
    simulate(dynamics, until += step, observer, [](double) {});
  benchmark::DoNotOptimize(observer.count);
  state.SetItemsProcessed(static_cast<std::int64_t>(dynamics.events() - before));
}

void closed_reference(benchmark::State& state) {
  const Case of(state);
  auto simulator = reference::heap_simulator<double>(of.chain.sigma, of.chain.cell_length, of.start);
  if (!of.chain.deterministic()) simulator.scatter_with(of.chain.gamma / of.chain.cells, 1);
  reference::HeapSimulator<double>::Event event{};
  Persistent observer;
  const auto advance = [&](std::uint64_t events) {
    for (; events > 0 && simulator.step(end_time, event); --events)
      observer.add(event.p_before, event.p_after);
  };
  if (of.chain.deterministic()) advance(static_cast<std::uint64_t>(settling) * of.chain.particles());
  constexpr std::uint64_t events = 2000;
  for ([[maybe_unused]] const auto iteration : state) advance(events);
  benchmark::DoNotOptimize(observer.count);
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * events));
}

void closed_floor(benchmark::State& state) {
  const Case of(state);
  const Scattering scatter(of.chain);
  const FreeFlight free_flight(of.chain, {1, 0}, of.chain.particles());
  std::vector<Flight> flights = first_flights(of.chain, of.start, free_flight);
  // Unshuffled, neighbours in memory meet the same scatterer, and each collision waits for the one before.
  std::shuffle(flights.begin(), flights.end(), std::mt19937(1));
  std::vector<double> scatterers = scatter.rule().scaled(of.start.scatterers);
  Persistent observer;
  std::size_t slot = 0;
  const auto advance = [&]<bool stochastic>(std::uint64_t events) {
    for (; events > 0; --events) {
      Flight& flight = flights[slot];
      const double before = flight.velocity;
      scatter.operator()<stochastic>(flight, scatterers[flight.target], free_flight);
      observer.add(before, flight.velocity);
      if (++slot == of.chain.particles()) slot = 0;
    }
  };
  constexpr std::uint64_t events = 100'000;
  for ([[maybe_unused]] const auto iteration : state) {
    if (of.chain.deterministic())
      advance.operator()<false>(events);
    else
      advance.operator()<true>(events);
  }
  benchmark::DoNotOptimize(observer.count);
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * events));
}

/// A short run, construction included. Arrivals after its end are frozen or remain pending.
void short_run(benchmark::State& state) {
  const ClosedChain chain{1000, 50, 1, 0.5};
  const PhasePoint start = closed_chain_start(chain, {}, false, {1, 0});
  const double end = static_cast<double>(state.range(0)) * chain.particles() / expected_rate(chain, start);
  const bool freeze = state.range(1) != 0;
  Persistent observer;
  std::uint64_t events = 0;
  for ([[maybe_unused]] const auto iteration : state) {
    ClosedDynamics dynamics(chain, start, freeze ? end : end_time, {1, 0});
    simulate(dynamics, end, observer, [](double) {});
    events += dynamics.events();
  }
  benchmark::DoNotOptimize(observer.count);
  state.SetItemsProcessed(static_cast<std::int64_t>(events));
}

// The number of iterations is fixed, as the preparation of a large chain takes longer than they do.
void all_sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"cells", "particles_per_cell", "gamma"})->Iterations(100);
  for (const std::int64_t gamma : {0, 1}) {
    benchmark->Args({11, 20, gamma})->Args({50, 20, gamma})->Args({1000, 50, gamma});
    benchmark->Args({10'000, 100, gamma})->Args({100'000, 100, gamma});
  }
}

// Up to 10^6 particles, and at gamma = 1, where every scatterer is visited, up to 1000 cells.
void affordable_sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"cells", "particles_per_cell", "gamma"})->Iterations(100);
  benchmark->Args({11, 20, 0})->Args({50, 20, 0})->Args({1000, 50, 0})->Args({10'000, 100, 0});
  benchmark->Args({11, 20, 1})->Args({50, 20, 1});
}

BENCHMARK(closed_engine)->Apply(all_sizes);
BENCHMARK(closed_reference)->Apply(affordable_sizes);
BENCHMARK(closed_floor)->Apply(all_sizes);
BENCHMARK(short_run)
    ->ArgNames({"events_per_particle", "freeze"})
    ->ArgsProduct({{1, 10, 100}, {0, 1}})
    ->Unit(benchmark::kMillisecond);

}  // namespace
