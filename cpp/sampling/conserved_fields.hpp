#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "model/closed_chain.hpp"
#include "model/collision.hpp"
#include "model/phase_point.hpp"

namespace lorentz {

/// What a closed chain conserves.
struct Conserved {
  // NOLINTNEXTLINE(cppcoreguidelines-use-enum-class): they are indices
  enum : std::size_t { number, energy, momentum };
};

/// Of every cell, by Conserved: the number of the particles inside, and energy and momentum of these and the
/// scatterer.
using ConservedFields = std::array<std::vector<double>, 3>;

/// Number of the cell in which a particle is.
inline std::uint32_t cell_of(const Particle& particle, const ClosedChain& chain) {
  return std::min(static_cast<std::uint32_t>(particle.position / chain.cell_length), chain.cells - 1);
}

inline ConservedFields conserved_fields(const PhasePoint& point, const ClosedChain& chain) {
  const double root_mass = CollisionRule(chain.sigma).root_mass();
  ConservedFields fields;
  fields.fill(std::vector<double>(chain.cells, 0));
  for (std::uint32_t cell = 0; cell < chain.cells; ++cell) {
    const double U = point.scatterers[cell];
    fields[Conserved::energy][cell] = 0.5 * U * U;
    fields[Conserved::momentum][cell] = root_mass * U;
  }
  for (const Particle& particle : point.particles) {
    const std::uint32_t cell = cell_of(particle, chain);
    fields[Conserved::number][cell] += 1;
    fields[Conserved::energy][cell] += 0.5 * particle.velocity * particle.velocity;
    fields[Conserved::momentum][cell] += particle.velocity;
  }
  return fields;
}

}  // namespace lorentz
