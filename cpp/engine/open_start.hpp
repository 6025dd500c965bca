#pragma once

#include "model/open_chain.hpp"
#include "model/phase_point.hpp"
#include "numerics/stream_key.hpp"

namespace lorentz {

/// No particles, scatterers at rest: the start of the paper.
PhasePoint empty_start(const OpenChain& chain);

/// Near the stationary state: in every cell as many particles, and as hot, as a stream like that of a
/// reservoir would hold there, its rate nu and its nu T on straight lines between `left` and `right`;
/// scatterers Gaussian at the same temperature.
///
/// The density of such a stream, F(p)/|p|, cannot be normalised: slow particles have gathered since the
/// beginning. The chain is given the age `age`, so particles that would not have finished a flight within it
/// are as many as entered. With the chain's own reservoirs the start is a guess that is close for gamma = N;
/// the relaxation has to make it forgotten.
PhasePoint local_equilibrium_start(const OpenChain& chain, const Reservoir& left, const Reservoir& right,
                                   double age, const StreamKey& key);

}  // namespace lorentz
