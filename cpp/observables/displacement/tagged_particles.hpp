#pragma once

#include <cstdint>
#include <vector>

#include "engine/observation.hpp"
#include "sampling/closed_run.hpp"

namespace lorentz {

/// Means over particles of powers of the displacement x: x^2, x^4, x.
struct Displacement {
  double square = 0, fourth = 0, mean = 0;
};

/// Observer that follows the displacement of every particle of a closed run, unwrapped from the ring, from
/// the time `since` on.
class TaggedParticles {
 public:
  TaggedParticles(const ClosedRun& run, double since, double cell_length)
      : run_(run),
        cell_length_(cell_length),
        start_(run.chain().positions_from_targets(run.clock(since))),
        cells_(start_.size(), 0) {}

  void on_flight(const Departure& departure) { cells_[departure.particle] += departure.cells; }

  /// Moments of the displacement at `time`, to which the run has advanced.
  Displacement displacement(double time) const {
    const std::vector<double> now = run_.chain().positions_from_targets(run_.clock(time));
    Displacement sums;
    for (std::size_t i = 0; i < start_.size(); ++i) {
      const double x = static_cast<double>(cells_[i]) * cell_length_ + now[i] - start_[i];
      sums.square += x * x;
      sums.fourth += x * x * x * x;
      sums.mean += x;
    }
    const auto particles = static_cast<double>(start_.size());
    return {sums.square / particles, sums.fourth / particles, sums.mean / particles};
  }

 private:
  const ClosedRun& run_;
  double cell_length_;
  std::vector<double> start_;        // positions relative to the target
  std::vector<std::int64_t> cells_;  // cells by which the target has moved since then
};

}  // namespace lorentz
