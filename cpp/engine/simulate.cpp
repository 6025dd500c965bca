#include "engine/simulate.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace lorentz {
namespace {

/// The flight of a particle to the first scatterer ahead of it; scatterers stand at (i + 1/2) times
/// the cell length.
Flight first_flight(const ClosedChain& chain, const Particle& particle) {
  const double cells_from_first = particle.position / chain.cell_length - 0.5;
  const bool rightwards = particle.velocity > 0;
  const double target = rightwards ? std::floor(cells_from_first) + 1 : std::ceil(cells_from_first) - 1;
  const double distance = std::abs(target - cells_from_first) * chain.cell_length;
  const auto index = (static_cast<std::int64_t>(target) + chain.cells) % chain.cells;
  return {distance / std::abs(particle.velocity), particle.velocity, static_cast<std::uint32_t>(index),
          EventQueue::none};
}

std::vector<Flight> first_flights(const ClosedChain& chain, const PhasePoint& start) {
  std::vector<Flight> flights;
  flights.reserve(start.particles.size());
  for (const Particle& particle : start.particles) flights.push_back(first_flight(chain, particle));
  return flights;
}

/// Collisions per unit time once the energy is shared equally: the mean |u| of all particles.
double expected_rate(const ClosedChain& chain, const PhasePoint& start) {
  double twice_energy = 0;
  for (const Particle& particle : start.particles) twice_energy += particle.velocity * particle.velocity;
  for (const double scatterer : start.scatterers) twice_energy += scatterer * scatterer;
  const auto particles = static_cast<double>(start.particles.size());
  const double temperature = twice_energy / (particles + static_cast<double>(start.scatterers.size()));
  return particles * std::sqrt(2 * temperature / std::numbers::pi) / chain.cell_length;
}

std::vector<double> scaled(const std::vector<double>& scatterers, double scale) {
  std::vector<double> result;
  result.reserve(scatterers.size());
  for (const double scatterer : scatterers) result.push_back(scatterer / scale);
  return result;
}

}  // namespace

ClosedDynamics::ClosedDynamics(const ClosedChain& chain, const PhasePoint& start, double end_time)
    : chain_(chain),
      collide_(chain.sigma),
      scatterers_(scaled(start.scatterers, collide_.scatterer_scale())),
      queue_(first_flights(chain, start), expected_rate(chain, start), end_time) {
  if (start.particles.size() != chain.particles() || start.scatterers.size() != chain.cells)
    throw std::invalid_argument(
        "the phase point does not have the chain's number of particles and scatterers");
}

Invariants ClosedDynamics::invariants() const {
  Invariants sum;
  for (const Flight& flight : queue_.flights()) {
    sum.energy += 0.5 * flight.velocity * flight.velocity;
    sum.momentum += flight.velocity;
    sum.momentum_scale += std::abs(flight.velocity);
  }
  for (const double w : scatterers_) {
    const double scatterer = collide_.scatterer_scale() * w;
    sum.energy += 0.5 * scatterer * scatterer;
    sum.momentum += collide_.root_mass() * scatterer;
    sum.momentum_scale += collide_.root_mass() * std::abs(scatterer);
  }
  if (chain_.sigma == 1) sum.momentum = std::numeric_limits<double>::quiet_NaN();
  return sum;
}

}  // namespace lorentz
