#include "engine/flights.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

namespace lorentz {
namespace {

Flight flight_over(const ClosedChain& chain, const Particle& particle, std::int64_t cells,
                   std::uint32_t number) {
  const double cells_from_first = particle.position / chain.cell_length - 0.5;
  const bool rightwards = direction(particle.velocity) > 0;
  const double ahead = rightwards ? std::floor(cells_from_first) + 1 : std::ceil(cells_from_first) - 1;
  const double target = ahead + static_cast<double>(rightwards ? cells - 1 : 1 - cells);
  const double distance = std::abs(target - cells_from_first) * chain.cell_length;
  const auto around = static_cast<std::int64_t>(chain.cells);
  const std::int64_t index = static_cast<std::int64_t>(target) % around;
  return {distance / std::abs(particle.velocity), particle.velocity,
          static_cast<std::uint32_t>(index < 0 ? index + around : index), number};
}

}  // namespace

Flight first_flight(const ClosedChain& chain, const Particle& particle, std::uint32_t number,
                    const Rules& rule, const FreeFlight& free_flight) {
  double velocity = particle.velocity;
  const bool direction_drawn = std::visit(
      [&]<class Rule>(const Rule&) {
        if constexpr (DrawsDirection<Rule>) {
          RandomStream random = free_flight.of_collision(number, particle.draws);
          Rule::draw_direction(velocity, random);
        }
        return DrawsDirection<Rule>;
      },
      rule);
  const std::int64_t cells = free_flight.passing() ? free_flight.cells(number, particle.draws) : 1;
  Flight flight = flight_over(chain, {particle.position, velocity}, cells, number);
  flight.draws = particle.draws + (direction_drawn || free_flight.passing() ? 1 : 0);
  return flight;
}

std::vector<Flight> first_flights(const ClosedChain& chain, const PhasePoint& start, const Rules& rule,
                                  const FreeFlight& free_flight) {
  std::vector<Flight> flights;
  flights.reserve(start.particles.size());
  for (const Particle& particle : start.particles)
    flights.push_back(
        first_flight(chain, particle, static_cast<std::uint32_t>(flights.size()), rule, free_flight));
  return flights;
}

double expected_rate(const ClosedChain& chain, const PhasePoint& start) {
  double twice_energy = 0;
  for (const Particle& particle : start.particles) twice_energy += particle.velocity * particle.velocity;
  for (const double scatterer : start.scatterers) twice_energy += scatterer * scatterer;
  const auto particles = static_cast<double>(start.particles.size());
  const double temperature = twice_energy / (particles + static_cast<double>(start.scatterers.size()));
  return particles * std::sqrt(2 * temperature / std::numbers::pi) * chain.scattering_probability() /
         chain.cell_length;
}

double position_from_target(const Flight& flight, double time, double cell_length) {
  // A particle too slow for its arrival to be a number has not moved since it left the scatterer.
  if (!std::isfinite(flight.time)) return std::copysign(cell_length, -flight.velocity);
  return flight.velocity * (time - flight.time);
}

double position(const Flight& flight, double time, const ClosedChain& chain) {
  const double length = chain.cells * chain.cell_length;
  const double unwrapped =
      (flight.target + 0.5) * chain.cell_length + position_from_target(flight, time, chain.cell_length);
  const double wrapped = unwrapped - length * std::floor(unwrapped / length);
  return wrapped < length ? wrapped : 0;
}

}  // namespace lorentz
