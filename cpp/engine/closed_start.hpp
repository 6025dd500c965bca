#pragma once

#include "engine/random.hpp"
#include "model/closed_chain.hpp"
#include "model/phase_point.hpp"

namespace lorentz {

struct StartTemperatures {
  double particles = 500;  // variance of u
  double scatterers = 0;   // variance of U; 0: at rest, as in the paper
};

/// The start of a closed chain: in every cell particles_per_cell particles uniform in position,
/// all momenta Gaussian. With zero_total_momentum one shift of all particle momenta makes
/// sum p + sum P = 0.
PhasePoint closed_chain_start(const ClosedChain& chain, const StartTemperatures& temperatures,
                              bool zero_total_momentum, const StreamKey& key);

}  // namespace lorentz
