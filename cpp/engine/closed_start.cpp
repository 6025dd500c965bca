#include "engine/closed_start.hpp"

#include <numeric>

#include "model/rules/elastic.hpp"

namespace lorentz {
namespace {

void remove_total_momentum(PhasePoint& start, double sigma) {
  double total =
      Elastic(sigma).root_mass() * std::accumulate(start.scatterers.begin(), start.scatterers.end(), 0.0);
  for (const Particle& particle : start.particles) total += particle.velocity;
  const double shift = total / static_cast<double>(start.particles.size());
  for (Particle& particle : start.particles) particle.velocity -= shift;
}

}  // namespace

PhasePoint closed_chain_start(const ClosedChain& chain, const StartTemperatures& temperatures,
                              bool zero_total_momentum, const StreamKey& key) {
  RandomStream position(key, Purpose::initial_position, 0);
  RandomStream particle_momentum(key, Purpose::initial_particle_momentum, 0);
  RandomStream scatterer_momentum(key, Purpose::initial_scatterer_momentum, 0);
  const double particle_speed = std::sqrt(temperatures.particles);
  const double scatterer_speed = std::sqrt(temperatures.scatterers);

  PhasePoint start;
  start.particles.reserve(chain.particles());
  start.scatterers.reserve(chain.cells);
  for (std::uint32_t cell = 0; cell < chain.cells; ++cell) {
    for (std::uint32_t k = 0; k < chain.particles_per_cell; ++k) {
      start.particles.push_back(
          {(cell + position.uniform()) * chain.cell_length, particle_speed * particle_momentum.gaussian()});
    }
    start.scatterers.push_back(scatterer_speed * scatterer_momentum.gaussian());
  }
  if (zero_total_momentum) remove_total_momentum(start, chain.sigma);
  return start;
}

}  // namespace lorentz
