#pragma once

#include <cmath>

#include "model/reservoir.hpp"
#include "numerics/random.hpp"

namespace lorentz {

/// Sampler of the particles that a reservoir injects [eq. 5].
/// pdf: intervals exponential with mean 1/nu; momenta half-Gaussian, sqrt(2/(pi T)) exp(-p^2/2T), p > 0.
/// Method: inversion for the intervals, the magnitude of a Box-Muller normal number for the momenta.
/// Validity: nu >= 0, T > 0; at nu = 0 nothing ever enters.
/// Reference: Box and Muller, Ann. Math. Statist. 29, 610 (1958), doi:10.1214/aoms/1177706645.
class Injector {
 public:
  Injector(const Reservoir& reservoir, const StreamKey& key, Purpose purpose)
      : mean_interval_(1 / reservoir.rate),
        thermal_(std::sqrt(reservoir.temperature)),
        stream_(key, purpose, 0) {
    advance();
  }

  /// When the next particle enters; infinite at rate 0.
  double time() const { return time_; }

  /// Returns |u| of that particle and goes on to the next one.
  double take() {
    advance();
    return thermal_ * std::abs(stream_.gaussian());
  }

 private:
  void advance() { time_ += mean_interval_ * stream_.exponential(); }

  double mean_interval_, thermal_;
  RandomStream stream_;
  double time_ = 0;
};

}  // namespace lorentz
