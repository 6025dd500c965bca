#include "engine/simulate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace lorentz {
namespace {

/// The flight of a particle to the first scatterer ahead of it, and on to where it scatters; scatterers
/// stand at (i + 1/2) times the cell length.
Flight first_flight(const ClosedChain& chain, const Particle& particle, std::int64_t cells) {
  const double cells_from_first = particle.position / chain.cell_length - 0.5;
  const bool rightwards = particle.velocity > 0;
  const double ahead = rightwards ? std::floor(cells_from_first) + 1 : std::ceil(cells_from_first) - 1;
  const double target = ahead + static_cast<double>(rightwards ? cells - 1 : 1 - cells);
  const double distance = std::abs(target - cells_from_first) * chain.cell_length;
  const auto around = static_cast<std::int64_t>(chain.cells);
  const std::int64_t index = static_cast<std::int64_t>(target) % around;
  return {distance / std::abs(particle.velocity), particle.velocity,
          static_cast<std::uint32_t>(index < 0 ? index + around : index), EventQueue::none};
}

std::vector<Flight> first_flights(const ClosedChain& chain, const PhasePoint& start, Launch& launch) {
  std::vector<Flight> flights;
  flights.reserve(start.particles.size());
  for (const Particle& particle : start.particles) {
    double velocity = particle.velocity;
    const auto slot = static_cast<std::uint32_t>(flights.size());
    const std::int64_t cells = launch.deterministic() ? 1 : launch(slot, velocity);
    flights.push_back(first_flight(chain, {particle.position, velocity}, cells));
  }
  return flights;
}

/// Collisions per unit time once the energy is shared equally: the mean |u| of all particles, over the mean
/// length of a flight.
double expected_rate(const ClosedChain& chain, const PhasePoint& start) {
  double twice_energy = 0;
  for (const Particle& particle : start.particles) twice_energy += particle.velocity * particle.velocity;
  for (const double scatterer : start.scatterers) twice_energy += scatterer * scatterer;
  const auto particles = static_cast<double>(start.particles.size());
  const double temperature = twice_energy / (particles + static_cast<double>(start.scatterers.size()));
  const double scattering_probability = std::min(1.0, chain.gamma / chain.cells);
  return particles * std::sqrt(2 * temperature / std::numbers::pi) * scattering_probability /
         chain.cell_length;
}

std::vector<double> scaled(const std::vector<double>& scatterers, double scale) {
  std::vector<double> result;
  result.reserve(scatterers.size());
  for (const double scatterer : scatterers) result.push_back(scatterer / scale);
  return result;
}

/// Checked first of all members, so that nothing is built from a phase point that does not fit.
const ClosedChain& checked(const ClosedChain& chain, const PhasePoint& start) {
  if (start.particles.size() != chain.particles() || start.scatterers.size() != chain.cells)
    throw std::invalid_argument(
        "the phase point does not have the chain's numbers of particles and scatterers");
  return chain;
}

}  // namespace

ClosedDynamics::ClosedDynamics(const ClosedChain& chain, const PhasePoint& start, double end_time,
                               std::uint64_t seed, std::uint64_t replica)
    : chain_(checked(chain, start)),
      collide_(chain.sigma),
      scatterers_(scaled(start.scatterers, collide_.scatterer_scale())),
      launch_(chain, seed, replica),
      queue_(first_flights(chain, start, launch_), expected_rate(chain, start), end_time) {}

double ClosedDynamics::position_from_target(std::uint32_t particle, double time) const {
  const Flight& flight = queue_.flights()[particle];
  // A particle too slow for its arrival to be a number has not moved since it left the scatterer.
  if (!std::isfinite(flight.time)) return std::copysign(chain_.cell_length, -flight.velocity);
  return flight.velocity * (time - flight.time);
}

std::vector<double> ClosedDynamics::scatterers() const {
  std::vector<double> result;
  result.reserve(scatterers_.size());
  for (const double w : scatterers_) result.push_back(collide_.scatterer_scale() * w);
  return result;
}

PhasePoint ClosedDynamics::phase_point(double time) const {
  const double length = chain_.cells * chain_.cell_length;
  PhasePoint point{{}, scatterers()};
  point.particles.reserve(particles());
  for (std::uint32_t particle = 0; particle < particles(); ++particle) {
    const Flight& flight = queue_.flights()[particle];
    const double unwrapped =
        (flight.target + 0.5) * chain_.cell_length + position_from_target(particle, time);
    const double wrapped = unwrapped - length * std::floor(unwrapped / length);
    point.particles.push_back({wrapped < length ? wrapped : 0, flight.velocity});
  }
  return point;
}

Invariants ClosedDynamics::invariants() const {
  Invariants sum;
  for (const Flight& flight : queue_.flights()) {
    sum.energy += 0.5 * flight.velocity * flight.velocity;
    sum.momentum += flight.velocity;
    sum.momentum_scale += std::abs(flight.velocity);
  }
  for (const double scatterer : scatterers()) {
    sum.energy += 0.5 * scatterer * scatterer;
    sum.momentum += collide_.root_mass() * scatterer;
    sum.momentum_scale += collide_.root_mass() * std::abs(scatterer);
  }
  if (chain_.sigma == 1 || chain_.random_direction) sum.momentum = std::numeric_limits<double>::quiet_NaN();
  return sum;
}

}  // namespace lorentz
