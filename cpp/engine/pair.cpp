#include "engine/pair.hpp"

namespace lorentz {

PairDynamics::PairDynamics(const ClosedChain& chain, const PhasePoint& plain, const PhasePoint& perturbed,
                           double end_time, const StreamKey& key, bool share)
    : chain_(chain),
      scatter_(chain),
      launch_(chain, key),
      places_(chain.particles(), single),
      double_flights_(1),
      double_scatterers_(chain.cells, false),
      queue_(first_events(plain, perturbed, end_time, share), expected_rate(chain, plain), end_time) {
  const std::vector<double> one = scatter_.rule().scaled(plain.scatterers);
  const std::vector<double> other = scatter_.rule().scaled(perturbed.scatterers);
  for (std::uint32_t cell = 0; cell < chain.cells; ++cell) {
    scatterers_.push_back({one[cell], other[cell]});
    if (share && plain.scatterers[cell] == perturbed.scatterers[cell]) continue;
    double_scatterers_[cell] = true;
    double_cells_.push_back(cell);
  }
}

/// The first flight of every particle, and of the second copy of those that differ or, without share, of all.
/// What happens to a single particle after the end concerns neither trajectory's difference.
std::vector<Flight> PairDynamics::first_events(const PhasePoint& plain, const PhasePoint& perturbed,
                                               double end_time, bool share) {
  std::vector<Flight> flights;
  for (std::uint32_t number = 0; number < chain_.particles(); ++number) {
    const Particle &one = plain.particles[number], &other = perturbed.particles[number];
    const Flight flight = first_flight(chain_, one, number, launch_);
    if (share && one.velocity == other.velocity && one.position == other.position) {
      if (flight.time < end_time) flights.push_back(flight);
      continue;
    }
    Flight twin = first_flight(chain_, other, number, launch_);
    twin.particle += chain_.particles();
    flights.insert(flights.end(), {flight, twin});
    add_double_particle(flight, twin);
  }
  return flights;
}

std::uint32_t PairDynamics::add_double_particle(const Flight& plain, const Flight& perturbed) {
  const auto place = static_cast<std::uint32_t>(double_flights_.size());
  double_flights_.push_back({plain, perturbed});
  return places_[plain.particle] = place;
}

void PairDynamics::add_double_scatterer(std::uint32_t cell) {
  double_scatterers_[cell] = true;
  double_cells_.push_back(cell);
  scatterers_[cell][1] = scatterers_[cell][0];
}

}  // namespace lorentz
