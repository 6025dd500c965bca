/// Solution of the kinetic equation to 1e-10, set-up and error estimate included.
#include <benchmark/benchmark.h>

#include "boltzmann/refinement.hpp"

namespace {

using namespace lorentz;

void kinetic_equation(benchmark::State& state) {
  KineticProblem problem;
  problem.sigma = static_cast<double>(state.range(0)) / 100;
  problem.gamma = static_cast<double>(state.range(1));
  double error = 0, evaluations = 0;
  for ([[maybe_unused]] const auto iteration : state) {
    const RefinedSolution solution = refine(problem, 1e-10);
    error = solution.error;
    evaluations = solution.evaluations;
  }
  state.counters["error"] = error;
  state.counters["evaluations"] = evaluations;
}

BENCHMARK(kinetic_equation)
    ->ArgNames({"100sigma", "gamma"})
    ->ArgsProduct({{50}, {1, 10, 50}})
    ->Args({-50, 1})
    ->Args({90, 1})
    ->Args({5, 1})
    ->Unit(benchmark::kMillisecond);

}  // namespace
