#pragma once

#include <cmath>
#include <numbers>

#include "model/portable.hpp"

namespace lorentz {

/// A bath that injects particles at one end of an open chain: a Poisson process in time, momenta
/// half-Gaussian with the flux distribution F(p) = rate sqrt(2/(pi T)) exp(-p^2/2T) on the half line that
/// points inwards (m = k_B = 1; the paper prints half of it).
struct Reservoir {
  double rate;         // nu: particles per unit time
  double temperature;  // T

  double mean_momentum() const { return std::sqrt(2 * temperature / std::numbers::pi); }  // of |p|
  double mean_energy() const { return 0.5 * temperature; }

  /// Probability of |p| in [low, high].
  double probability(double low, double high) const {
    const double scale = 1 / std::sqrt(2 * temperature);
    return portable::erfc(low * scale) - portable::erfc(high * scale);
  }
};

}  // namespace lorentz
