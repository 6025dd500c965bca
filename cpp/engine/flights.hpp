#pragma once

#include <vector>

#include "engine/flight.hpp"
#include "engine/free_flight.hpp"
#include "model/closed_chain.hpp"
#include "model/phase_point.hpp"
#include "model/rules.hpp"

namespace lorentz {

/// The flight of a particle to the scatterer where it scatters first. Scatterers are at (i + 1/2) times the
/// cell length.
Flight first_flight(const ClosedChain& chain, const Particle& particle, std::uint32_t number,
                    const Rules& rule, const FreeFlight& free_flight);

/// First flights of all particles.
std::vector<Flight> first_flights(const ClosedChain& chain, const PhasePoint& start, const Rules& rule,
                                  const FreeFlight& free_flight);

/// Collisions per unit time once the energy is shared equally: the mean |u| of all particles, over the mean
/// length of a flight.
double expected_rate(const ClosedChain& chain, const PhasePoint& start);

/// Position relative to the scatterer at the end of the flight: negative while it goes to the right.
double position_from_target(const Flight& flight, double time, double cell_length);

/// Position on the ring, in [0, cells * cell_length).
double position(const Flight& flight, double time, const ClosedChain& chain);

}  // namespace lorentz
