#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "model/closed_chain.hpp"
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

ConservedFields conserved_fields(const PhasePoint& point, const ClosedChain& chain);

/// Number of the cell in which a particle is.
std::uint32_t cell_of(const Particle& particle, const ClosedChain& chain);

}  // namespace lorentz
