#pragma once

#include "model/closed_chain.hpp"
#include "model/phase_point.hpp"
#include "numerics/random.hpp"

namespace lorentz {

struct StartTemperatures {
  double particles = 500;  // variance of u
  double scatterers = 0;   // variance of U; 0: at rest, as in the paper
};

/// Sampler of the start of a closed chain.
/// pdf: in every cell particles_per_cell particles, uniform in position; all u and U Gaussian.
/// Method: Box-Muller; with zero_total_momentum one shift of all u makes sum p + sum P = 0 [eq. 3].
/// Validity: temperatures >= 0.
/// Reference: Box and Muller, Ann. Math. Statist. 29, 610 (1958), doi:10.1214/aoms/1177706645.
PhasePoint closed_chain_start(const ClosedChain& chain, const StartTemperatures& temperatures,
                              bool zero_total_momentum, const StreamKey& key);

}  // namespace lorentz
