#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "model/open_chain.hpp"
#include "statistics/time_integral.hpp"

namespace lorentz {

/// A control variate for the mean energy of one scatterer that particles hit by chance, gamma < N.
///
/// A collision changes U^2 by g = (c u + sigma U)^2 - U^2, with c^2 = 1 - sigma^2. Whether a particle that
/// arrives is scattered is drawn anew with probability q = gamma/N, whatever happened before. So the sum over
/// all arrivals of (1 if scattered, else 0, minus q) g has mean 0: it is a martingale.
///
/// What it knows: over the collisions g adds up to the change of U^2 in the window, next to nothing. There
/// remains -q times the sum over all arrivals, where g is c^2 (u^2 - U^2) and a cross term of mean near 0. It
/// thus tells by how much the scatterer's energy exceeded that of all who arrived, N/gamma times as many as
/// were scattered, and takes away what the choice among them added.
class ScatteringControl {
 public:
  ScatteringControl(const OpenChain& chain, const Blocks& blocks)
      : sigma_(chain.sigma),
        c_(std::sqrt((1 - chain.sigma) * (1 + chain.sigma))),
        probability_(chain.deterministic() ? 1 : chain.gamma / chain.cells),
        blocks_(blocks),
        sums_(blocks.count(), 0) {}

  /// A particle with velocity u will be there at a time, which the blocks contain, and will be scattered or
  /// not. Left out where nothing is left to chance.
  void expect(double time, double u, bool scattered) {
    if (probability_ < 1) pending_.push_back({time, u, (scattered ? 1 : 0) - probability_});
  }

  /// The scatterer has had the momentum U since the last call up to a time; a collision then still meets it.
  void hold(double scatterer, double until) {
    std::erase_if(pending_, [&](const Arrival& arrival) {
      if (arrival.time > until) return false;
      const double after = c_ * arrival.velocity + sigma_ * scatterer;
      sums_[blocks_[arrival.time]] += arrival.surprise * (after * after - scatterer * scatterer);
      return true;
    });
  }

  /// The sum over each block, with mean 0.
  const std::vector<double>& sums() const { return sums_; }

 private:
  struct Arrival {
    double time;
    double velocity;  // u
    double surprise;  // 1 or 0, minus its mean
  };

  double sigma_, c_, probability_;
  Blocks blocks_;
  std::vector<Arrival> pending_;
  std::vector<double> sums_;
};

}  // namespace lorentz
