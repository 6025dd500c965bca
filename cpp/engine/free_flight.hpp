#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "model/closed_chain.hpp"
#include "numerics/random.hpp"

namespace lorentz {

/// Sampler of the number k of cells to the next scattering, for the scattering probability q [eq. 7].
/// pdf: P(k) = (1-q)^(k-1) q, k = 1, 2, ...
/// Method: inversion, k = 1 + floor(ln xi / ln(1-q)) with a uniform xi.
/// Validity: all q, those beyond 1 as 1; k is at most 1 + 2^53, which no run reaches.
/// Reference: Devroye, Non-Uniform Random Variate Generation (Springer 1986), section X.2.
class GeometricCells {
 public:
  explicit GeometricCells(double q) : log_pass_probability_(std::log1p(-std::min(1.0, q))) {}

  std::int64_t operator()(double uniform_number) const {
    const double passed = std::log(uniform_number) / log_pass_probability_;
    constexpr double most = 0x1p53;
    return 1 + static_cast<std::int64_t>(passed < most ? passed : most);
  }

 private:
  double log_pass_probability_;
};

/// Random numbers of a closed chain, for its collision rule and for the number of cells of the flight that
/// follows.
/// pdf: GeometricCells with q = gamma/N.
/// Method: the random numbers come from counters, by (particle, draw); draws are counted by the particle, so
/// two chains with the same key share them as long as their particles scatter equally often.
/// Validity: scatterers in between are never visited, as each scatters independently of all else.
/// Reference: Salmon et al., SC11, doi:10.1145/2063384.2063405 (counter-based random numbers).
class FreeFlight {
 public:
  /// particles: their number. Numbers beyond are copies of the chain, which share random numbers.
  FreeFlight(const ClosedChain& chain, const StreamKey& key, std::size_t particles)
      : passing_(!chain.deterministic()),
        cells_to_scattering_(chain.scattering_probability()),
        key_(key),
        particles_(static_cast<std::uint32_t>(particles)) {}

  /// Whether a particle may pass a scatterer: cells() is 1 otherwise.
  bool passing() const { return passing_; }

  /// Number of cells to the next scattering. draw: number of those that the particle has taken before.
  std::int64_t cells(std::uint32_t particle, std::uint64_t draw) const {
    return cells_to_scattering_(stream(Purpose::passes, particle, draw).uniform());
  }

  /// Random numbers of the collision rule.
  RandomStream of_collision(std::uint32_t particle, std::uint64_t draw) const {
    return stream(Purpose::collision, particle, draw);
  }

 private:
  RandomStream stream(Purpose purpose, std::uint32_t particle, std::uint64_t draw) const {
    return {key_, purpose, particle % particles_, draw};
  }

  bool passing_;
  GeometricCells cells_to_scattering_;
  StreamKey key_;
  std::uint32_t particles_;
};

}  // namespace lorentz
