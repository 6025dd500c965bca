#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "model/closed_chain.hpp"
#include "numerics/elementary.hpp"
#include "numerics/random.hpp"

namespace lorentz {

/// Sampler of the number k of cells to the next scattering, for the scattering probability q [eq. 7].
/// pdf: P(k) = (1-q)^(k-1) q, k = 1, 2, ...
/// Method: inversion, k = 1 + floor(ln xi / ln(1-q)) with a uniform xi.
/// Validity: all q, those beyond 1 as 1; k is at most 1 + 2^53, which no run reaches.
/// Reference: Devroye, Non-Uniform Random Variate Generation (Springer 1986), section X.2.
class GeometricCells {
 public:
  explicit GeometricCells(double q) : log_pass_probability_(elementary::log1p(-std::min(1.0, q))) {}

  std::int64_t operator()(double uniform_number) const {
    const double passed = elementary::log(uniform_number) / log_pass_probability_;
    constexpr double most = 0x1p53;
    return 1 + static_cast<std::int64_t>(passed < most ? passed : most);
  }

 private:
  double log_pass_probability_;
};

/// Sampler of the flight after a collision in a closed chain: the number of cells, and the direction where it
/// is random.
/// pdf: GeometricCells with q = gamma/N, both directions with probability 1/2; independent.
/// Method: the random numbers come from counters, by (particle, draw); draws are counted by the particle, so
/// two chains with the same key share them as long as their particles scatter equally often.
/// Validity: scatterers in between are never visited, as each scatters independently of all else.
/// Reference: Salmon et al., SC11, doi:10.1145/2063384.2063405 (counter-based random numbers).
class FreeFlight {
 public:
  FreeFlight(const ClosedChain& chain, const StreamKey& key, std::size_t particles)
      : passing_(!chain.deterministic()),
        random_direction_(chain.random_direction),
        cells_to_scattering_(chain.gamma / chain.cells),
        key_(key),
        particles_(static_cast<std::uint32_t>(particles)) {}

  /// Nothing is drawn: one cell, direction kept.
  bool deterministic() const { return !passing_ && !random_direction_; }

  /// Returns the number of cells and sets the direction of u. number: of the particle, modulo the number of
  /// particles, so that several copies of the chain share random numbers. draws: those that the particle has
  /// taken so far.
  std::int64_t operator()(std::uint32_t number, std::uint64_t& draws, double& u) const {
    const std::uint64_t draw = draws++;
    const std::uint32_t particle = number % particles_;
    if (random_direction_) u = std::copysign(u, uniform(key_, Purpose::direction, particle, draw) - 0.5);
    if (!passing_) return 1;
    return cells_to_scattering_(uniform(key_, Purpose::passes, particle, draw));
  }

 private:
  bool passing_, random_direction_;
  GeometricCells cells_to_scattering_;
  StreamKey key_;
  std::uint32_t particles_;
};

}  // namespace lorentz
