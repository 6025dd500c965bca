#include "engine/stationary_start.hpp"

#include <gsl/gsl_sf_expint.h>

#include <cmath>

namespace lorentz {

PhasePoint stationary_start(const ClosedChain& chain, const StationaryMeasure& measure,
                            const StreamKey& key) {
  RandomStream number(key, Purpose::initial_number, 0);
  RandomStream position(key, Purpose::initial_position, 0);
  RandomStream particle_momentum(key, Purpose::initial_particle_momentum, 0);
  RandomStream scatterer_momentum(key, Purpose::initial_scatterer_momentum, 0);
  const double length = chain.cells * chain.cell_length, thermal_speed = std::sqrt(measure.temperature);
  const double faster = std::exp(-0.5);  // integral of the envelope above sqrt(T)
  const double all = faster + std::log(thermal_speed / measure.slowest);

  PhasePoint start;
  const double density = 2 * measure.fugacity * length;
  for (double points = number.exponential(); points < density * all; points += number.exponential()) {
    const double above = points / density;  // integral of the envelope over greater speeds
    const bool tail = above < faster;
    const double speed = tail ? std::sqrt(-2 * std::log(above)) : std::exp(faster - above);
    const double accepted = tail ? 1 / (speed * speed) : std::exp(-0.5 * speed * speed);
    const double drawn = particle_momentum.uniform(), sign = particle_momentum.uniform() - 0.5;
    if (drawn < accepted)
      start.particles.push_back({position.uniform() * length, std::copysign(thermal_speed * speed, sign)});
  }
  for (std::uint32_t cell = 0; cell < chain.cells; ++cell)
    start.scatterers.push_back(thermal_speed * scatterer_momentum.gaussian());
  return start;
}

double mean_number(const ClosedChain& chain, const StationaryMeasure& measure) {
  const double relative = measure.slowest / std::sqrt(measure.temperature);
  return measure.fugacity * chain.cell_length * gsl_sf_expint_E1(0.5 * relative * relative);
}

}  // namespace lorentz
