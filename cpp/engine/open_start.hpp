#pragma once

#include "model/open_chain.hpp"
#include "model/phase_point.hpp"
#include "numerics/stream_key.hpp"

namespace lorentz {

/// No particles, scatterers at rest: the start of the paper.
PhasePoint empty_start(const OpenChain& chain);

/// Sampler of a start near the stationary state.
/// pdf: in every cell a Poisson number of particles, uniform in position, with the density
/// F(p) min(1/|p|, age/flight) [eq. 23] of a half-Gaussian stream in each direction; the rate nu and the
/// power nu T of the stream are linear between `left` and `right`. Scatterers are Gaussian at temperature T.
/// Method: the speeds by composition and rejection, the Poisson number by exponential intervals.
/// Validity: close to the stationary state for gamma = N and the chain's own reservoirs, else a guess; the
/// relaxation removes the difference. F(p)/|p| cannot be normalised, hence the finite age.
/// Reference: docs/model.md, "Filling of the open chain".
PhasePoint local_equilibrium_start(const OpenChain& chain, const Reservoir& left, const Reservoir& right,
                                   double age, const StreamKey& key);

}  // namespace lorentz
