#pragma once

#include <cmath>
#include <cstdint>

#include "engine/random.hpp"
#include "model/closed_chain.hpp"
#include "model/portable.hpp"

namespace lorentz {

/// Number of cells to the next scattering, from a uniform number by inversion, where a particle passes a
/// scatterer with the probability whose logarithm is given: P(k) = pass^(k-1) (1 - pass), k = 1, 2, ...
inline std::int64_t cells_to_scattering(double uniform_number, double log_pass_probability) {
  const double passed = portable::log(uniform_number) / log_pass_probability;
  constexpr double most = 0x1p53;  // beyond it cells cannot be counted; no run gets there
  return 1 + static_cast<std::int64_t>(passed < most ? passed : most);
}

/// The chance in what follows a collision: how many cells a particle flies to its next scattering, and
/// in which direction where that is drawn.
///
/// Scattering has the probability gamma/N at every scatterer, so the number of cells is geometric,
/// it is drawn once and the scatterers in between are never visited. The draws of a particle are counted by
/// the particle, not by time, so two chains that start alike draw alike as long as their particles scatter
/// equally often.
class Launch {
 public:
  Launch(const ClosedChain& chain, const StreamKey& key)
      : passing_(!chain.deterministic()),
        random_direction_(chain.random_direction),
        log_pass_probability_(portable::log1p(-chain.gamma / chain.cells)),
        key_(key),
        particles_(chain.particles()) {}

  /// No chance at all: one cell, direction kept.
  bool deterministic() const { return !passing_ && !random_direction_; }

  /// Draws the direction of u where it is random, and the number of cells of the flight. Several
  /// copies of all particles, numbered one after the other, draw the same numbers. draws: those that the
  /// particle has taken so far.
  std::int64_t operator()(std::uint32_t number, std::uint64_t& draws, double& u) const {
    const std::uint64_t draw = draws++;
    const std::uint32_t particle = number % particles_;
    if (random_direction_) u = std::copysign(u, uniform(key_, Purpose::direction, particle, draw) - 0.5);
    if (!passing_) return 1;
    return cells_to_scattering(uniform(key_, Purpose::passes, particle, draw), log_pass_probability_);
  }

 private:
  bool passing_, random_direction_;
  double log_pass_probability_;
  StreamKey key_;
  std::uint32_t particles_;
};

}  // namespace lorentz
