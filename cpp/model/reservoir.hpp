#pragma once

#include <cmath>
#include <numbers>

namespace lorentz {

/// Heat bath that injects particles at one end of an open chain, as a Poisson process in time with
/// independent half-Gaussian momenta. The flux per unit time and momentum is F(p) = rate sqrt(2/(pi T))
/// exp(-p^2/2T) on the half line that points inwards [eq. 5]; the paper prints half of it. Units: m = k_B =
/// 1.
struct Reservoir {
  double rate;         // nu: particles per unit time
  double temperature;  // T

  double mean_momentum() const { return std::sqrt(2 * temperature / std::numbers::pi); }  // of |p| [eq. 6]
  double mean_energy() const { return 0.5 * temperature; }                                // of p^2/2 [eq. 6]

  /// Probability that |p| of an injected particle lies in [low, high].
  double probability(double low, double high) const {
    const double scale = 1 / std::sqrt(2 * temperature);
    return std::erfc(low * scale) - std::erfc(high * scale);
  }
};

/// Figure 2 of the paper: equal pressures [eq. 28] and a nonzero particle current [eq. 29].
inline constexpr Reservoir default_left{220, 900. / 11}, default_right{180, 1100. / 9};

}  // namespace lorentz
