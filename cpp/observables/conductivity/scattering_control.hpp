#pragma once

#include <cmath>
#include <vector>

#include "model/scatterers.hpp"

namespace lorentz {

/// Control variate for the mean energy of one scatterer with random scattering, gamma < N [eq. 31].
///
/// A collision changes U^2 by g = (c u + sigma U)^2 - U^2, c^2 = 1 - sigma^2. An arriving particle is
/// scattered with probability q = gamma/N, independently of the past. With s = 1 if it is scattered and s = 0
/// if not, the sum of (s - q) g over all arrivals is a martingale of mean 0.
///
/// It is correlated with the scatterer's energy. The sum of s g is the change of U^2 over the window, which
/// is bounded. The rest is -q times the sum of g over all arrivals, where g is c^2 (u^2 - U^2) plus a cross
/// term of mean near 0: the excess of the scatterer's energy over that of all arriving particles, N/gamma
/// times as many as are scattered. The regression removes the noise of the random selection among them.
///
/// Every function g of the velocities before the collision gives a martingale, so that the mean is 0 for
/// every collision rule. This g is the change of U^2 where the scatterer is scattered elastically; with other
/// rules the control is valid, but may reduce the variance less.
class ScatteringControl {
 public:
  explicit ScatteringControl(const Scatterers& chain)
      : sigma_(chain.sigma),
        c_(std::sqrt((1 - chain.sigma) * (1 + chain.sigma))),
        probability_(chain.scattering_probability()) {}

  /// Registers a particle of velocity u that arrives at a time in the window, and is scattered or
  /// not. Ignored for gamma = N, where the control is 0.
  void arrival(double time, double u, bool scattered) {
    if (probability_ < 1) pending_.push_back({time, u, (scattered ? 1 : 0) - probability_});
  }

  /// Adds the arrivals up to `until`, inclusive: since the last call the scatterer had the momentum U, which
  /// a collision at `until` still meets.
  void advance(double scatterer, double until) {
    std::erase_if(pending_, [&](const Arrival& arrival) {
      if (arrival.time > until) return false;
      const double after = c_ * arrival.velocity + sigma_ * scatterer;
      sum_ += arrival.residual * (after * after - scatterer * scatterer);
      return true;
    });
  }

  /// Its mean is 0.
  double sum() const { return sum_; }

 private:
  struct Arrival {
    double time;
    double velocity;  // u
    double residual;  // s - q
  };

  double sigma_, c_, probability_;
  double sum_ = 0;
  std::vector<Arrival> pending_;
};

}  // namespace lorentz
