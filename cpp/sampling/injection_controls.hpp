#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "engine/open_dynamics.hpp"
#include "model/open_chain.hpp"
#include "statistics/tally.hpp"

namespace lorentz {

/// Energy and particles that cross the openings, positive to the right. A crossing has the weight 1/2,
/// because a current is the mean over both openings [eq. 25].
struct OpeningCurrents {
  double energy = 0, particles = 0;

  void cross(double u) {
    energy += 0.25 * u * std::abs(u);
    particles += std::copysign(0.5, u);
  }

  friend OpeningCurrents operator+(const OpeningCurrents& a, const OpeningCurrents& b) {
    return {a.energy + b.energy, a.particles + b.particles};
  }
};

/// Control variates of every stationary measurement: numbers, momenta and energies that the reservoirs inject
/// in a window, minus their exact means [eq. 30].
class InjectionControls {
 public:
  static constexpr std::size_t count = 6;

  /// Axis of a tally of these controls.
  static Axis axis() {
    return {"injection", "1", "Number, sum |p|, energy: left reservoir, then right", {0, 1, 2, 3, 4, 5}};
  }

  void add(End end, double u) {
    double* const sums = sums_.data() + 3 * static_cast<std::size_t>(end);
    sums[0] += 1;
    sums[1] += std::abs(u);
    sums[2] += 0.5 * u * u;
  }

  friend InjectionControls operator+(InjectionControls a, const InjectionControls& b) {
    for (std::size_t i = 0; i < count; ++i) a.sums_[i] += b.sums_[i];
    return a;
  }

  /// Controls of a window of length `duration`.
  std::array<double, count> deviations(const OpenChain& chain, double duration) const {
    std::array<double, count> result = sums_;
    std::size_t i = 0;
    for (const Reservoir& reservoir : {chain.left, chain.right}) {
      const double injected = reservoir.rate * duration;
      for (const double mean : {1.0, reservoir.mean_momentum(), reservoir.mean_energy()})
        result[i++] -= injected * mean;
    }
    return result;
  }

 private:
  std::array<double, count> sums_{};
};

}  // namespace lorentz
