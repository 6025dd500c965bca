#pragma once

#include "model/closed_chain.hpp"
#include "model/phase_point.hpp"
#include "numerics/random.hpp"

namespace lorentz {

/// Parameters of the stationary measure of a closed chain [eq. 50] at rest on average. Only heat_current, of
/// the study "does the paper hold?", starts from it.
struct StationaryMeasure {
  double fugacity = 1;     // z of the flux z exp(-p^2/2T); 1/length
  double temperature = 1;  // T
  double slowest = 0.01;   // least |p| of a particle, because their number diverges as ln(1/slowest)
};

/// Sampler of the stationary measure, in which all totals fluctuate.
/// pdf: numbers of particles in cells are independent and Poissonian with mean_number per cell; positions are
/// uniform, momenta have the density exp(-p^2/2T)/|p| for |p| > slowest, and all U are Gaussian of variance
/// T.
/// Method: the speeds are points of a Poisson process of the density 2 z L exp(-p^2/2T)/p. Points of an
/// envelope, 1/p below sqrt(T) and p exp(-p^2/2T)/T above, are made in the order of decreasing p by
/// exponential gaps, and thinned.
/// Validity: 0 < slowest <= sqrt(T). Particles slower than `slowest` are missing: those of that flux would
/// meet a scatterer at the rate 2 z slowest.
/// Reference: Lewis and Shedler, Naval Res. Logist. Q. 26, 403 (1979), doi:10.1002/nav.3800260304.
PhasePoint stationary_start(const ClosedChain& chain, const StationaryMeasure& measure, const StreamKey& key);

/// Mean number of particles in a cell, 2 zeta Lambda [eq. 50]. Validity: that of stationary_start().
double mean_number(const ClosedChain& chain, const StationaryMeasure& measure);

}  // namespace lorentz
