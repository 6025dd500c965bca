#include "observables/energy_pulse/pair.hpp"

namespace lorentz {

PairDynamics::PairDynamics(const ClosedChain& chain, const PhasePoint& plain, const PhasePoint& perturbed,
                           double end_time, const StreamKey& key, bool share)
    : chain_(chain),
      rule_(make_rule(chain.rule, chain.sigma)),
      free_flight_(chain, key, chain.particles()),
      indices_(chain.particles(), shared),
      diverged_flights_(1),
      scatterer_diverged_(chain.cells, 0),
      queue_(first_events(plain, perturbed, end_time, share), expected_rate(chain, plain), end_time) {
  const std::vector<double> w = masses(rule_).scaled(plain.scatterers);
  const std::vector<double> perturbed_w = masses(rule_).scaled(perturbed.scatterers);
  for (std::uint32_t cell = 0; cell < chain.cells; ++cell) {
    scatterers_.push_back({w[cell], perturbed_w[cell]});
    // Copies have equal bits; any difference, however small, makes two trajectories.
    if (share && plain.scatterers[cell] == perturbed.scatterers[cell]) continue;
    scatterer_diverged_[cell] = 1;
    diverged_cells_.push_back(cell);
  }
}

/// The first flight of every particle, and of the perturbed copy of those that differ or, without share, of
/// all. A shared particle that arrives after the end is left out, as no difference comes of it.
std::vector<Flight> PairDynamics::first_events(const PhasePoint& plain, const PhasePoint& perturbed,
                                               double end_time, bool share) {
  std::vector<Flight> flights;
  for (std::uint32_t number = 0; number < chain_.particles(); ++number) {
    const Particle &one = plain.particles[number], &other = perturbed.particles[number];
    const Flight flight = first_flight(chain_, one, number, rule_, free_flight_);
    if (share && one.velocity == other.velocity && one.position == other.position) {
      if (flight.time < end_time) flights.push_back(flight);
      continue;
    }
    Flight copy = first_flight(chain_, other, number, rule_, free_flight_);
    copy.particle += chain_.particles();
    flights.insert(flights.end(), {flight, copy});
    diverge_particle(flight, copy);
  }
  return flights;
}

std::uint32_t PairDynamics::diverge_particle(const Flight& plain, const Flight& perturbed) {
  const auto index = static_cast<std::uint32_t>(diverged_flights_.size());
  diverged_flights_.push_back({plain, perturbed});
  return indices_[plain.particle] = index;
}

void PairDynamics::diverge_scatterer(std::uint32_t cell) {
  scatterer_diverged_[cell] = 1;
  diverged_cells_.push_back(cell);
  scatterers_[cell][1] = scatterers_[cell][0];
}

}  // namespace lorentz
