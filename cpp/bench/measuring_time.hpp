#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>

/// Events per particle until the queue is in its stationary state, slow flights included.
constexpr double settling = 16;

/// Events in one iteration, so that the measurement includes slow flights.
inline double events_per_iteration(const benchmark::State& state, double least, double particles) {
  return std::max(least, settling * particles / static_cast<double>(state.max_iterations));
}
