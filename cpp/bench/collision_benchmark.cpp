/// Speed and energy drift of three forms of the collision (docs/numerics.md).
/// Counter `drift`: relative change of the total energy over the run; `per_sqrt_event`: the same over
/// 2^-53 sqrt(events), of order 1 or less for a random walk of roundings, growing for a systematic drift.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>

#include "model/rules/elastic.hpp"
#include "numerics/random.hpp"

namespace {

using namespace lorentz;

/// u' = -sigma u + c U, U' = c u + sigma U as printed, with c rounded once.
struct PlainReflection {
  explicit PlainReflection(double s) : sigma(s), c(std::sqrt((1 - s) * (1 + s))) {}
  void operator()(double& u, double& U, std::uint32_t) const {
    const double u_before = u;
    u = -sigma * u_before + c * U;
    U = c * u_before + sigma * U;
  }
  static double scatterer_scale() { return 1; }
  double sigma, c;
};

/// The same with c = c_high + c_low and fused multiply-adds, which a portable build has to dispatch.
struct SplitReflection {
  explicit SplitReflection(double s) : sigma(s), c_high(std::sqrt((1 - s) * (1 + s))) {
    const long double c = std::sqrt((1 - static_cast<long double>(s)) * (1 + static_cast<long double>(s)));
    c_low = static_cast<double>(c - c_high);
  }
  __attribute__((target("fma"))) void operator()(double& u, double& U, std::uint32_t) const {
    const double u_before = u;
    u = __builtin_fma(c_high, U, __builtin_fma(c_low, U, -sigma * u_before));
    U = __builtin_fma(c_high, u_before, __builtin_fma(c_low, u_before, sigma * U));
  }
  static double scatterer_scale() { return 1; }
  double sigma, c_high, c_low;
};

constexpr std::size_t population = 64;  // a power of two

template <class Rule>
__attribute__((target("fma"))) void collisions(benchmark::State& state) {
  const double sigma = static_cast<double>(state.range(0)) / 100;
  const Rule collide(sigma);
  std::array<double, population> particles{}, scatterers{};
  RandomStream random({1, 0}, Purpose::initial_particle_momentum, 0);
  for (std::size_t i = 0; i < population; ++i) {
    particles[i] = random.gaussian();
    scatterers[i] = random.gaussian();
  }
  const auto energy = [&] {
    long double sum = 0;
    for (const double u : particles) sum += static_cast<long double>(u) * u;
    for (const double w : scatterers) {
      const long double U = static_cast<long double>(collide.scatterer_scale()) * w;
      sum += U * U;
    }
    return sum;
  };
  const long double before = energy();
  std::uint64_t pair = 1;
  for ([[maybe_unused]] const auto iteration : state) {
    pair = pair * 6364136223846793005ULL + 1442695040888963407ULL;  // the MMIX generator of Knuth
    collide(particles[(pair >> 40) % population], scatterers[(pair >> 50) % population], 0);
  }
  const auto drift = static_cast<double>(energy() / before - 1);
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()));
  state.counters["drift"] = drift;
  state.counters["per_sqrt_event"] =
      std::abs(drift) / (0x1p-53 * std::sqrt(static_cast<double>(state.iterations())));
}

void cases(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("100sigma")->Arg(50)->Arg(30)->Arg(-90)->Iterations(100'000'000);
}

BENCHMARK_TEMPLATE(collisions, PlainReflection)->Apply(cases);
BENCHMARK_TEMPLATE(collisions, SplitReflection)->Apply(cases);
BENCHMARK_TEMPLATE(collisions, Elastic)->Apply(cases);

}  // namespace
