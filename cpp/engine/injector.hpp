#pragma once

#include <cmath>

#include "engine/random.hpp"
#include "model/reservoir.hpp"

namespace lorentz {

/// The particles that a reservoir injects, one after the other.
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

  /// |u| of that particle. From now on time() is that of the one after it.
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
