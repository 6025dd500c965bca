#include "engine/pair.hpp"

#include <functional>

#include "engine/flights.hpp"

namespace lorentz {
namespace {

/// Flights of both trajectories; a single particle has no second flight yet.
std::vector<Flight> both(const ClosedChain& chain, const PhasePoint& plain, const PhasePoint& perturbed,
                         const Launch& launch, const std::vector<char>& double_particles) {
  std::vector<Flight> flights = first_flights(chain, plain, launch);
  for (Flight flight : first_flights(chain, perturbed, launch)) {
    if (!double_particles[flight.particle]) continue;
    flight.particle += chain.particles();
    flights.push_back(flight);
  }
  return flights;
}

/// One flag per element: whether a and b differ in it, or all.
template <class Element, class Differ>
std::vector<char> different(const std::vector<Element>& a, const std::vector<Element>& b, bool all,
                            Differ differ) {
  std::vector<char> flags;
  for (std::size_t i = 0; i < a.size(); ++i) flags.push_back(all || differ(a[i], b[i]));
  return flags;
}

}  // namespace

PairDynamics::PairDynamics(const ClosedChain& chain, const PhasePoint& plain, const PhasePoint& perturbed,
                           double end_time, const StreamKey& key, bool share)
    : chain_(chain),
      scatter_(chain),
      launch_(chain, key),
      double_particles_(different(plain.particles, perturbed.particles, !share,
                                  [](const Particle& a, const Particle& b) {
                                    return a.velocity != b.velocity || a.position != b.position;
                                  })),
      double_scatterers_(different(plain.scatterers, perturbed.scatterers, !share, std::not_equal_to<>())),
      scatterers_{scatter_.rule().scaled(plain.scatterers), scatter_.rule().scaled(perturbed.scatterers)},
      queue_(both(chain, plain, perturbed, launch_, double_particles_), expected_rate(chain, plain),
             end_time) {}

std::array<PhasePoint, 2> PairDynamics::phase_points(double time) const {
  const std::uint32_t particles = chain_.particles();
  PhasePoint plain{{}, scatter_.rule().unscaled(scatterers_[0])};
  const std::vector<Flight> flights = queue_.flights();
  const auto seen = [&](const Flight& flight) {
    return Particle{position(flight, time, chain_), flight.velocity, flight.draws};
  };
  for (std::uint32_t particle = 0; particle < particles; ++particle)
    plain.particles.push_back(seen(flights[particle]));

  PhasePoint perturbed = plain;
  for (std::uint32_t particle = 0; particle < particles; ++particle)
    if (double_particles_[particle]) perturbed.particles[particle] = seen(flights[particle + particles]);
  for (std::uint32_t cell = 0; cell < chain_.cells; ++cell)
    if (double_scatterers_[cell])
      perturbed.scatterers[cell] = scatter_.rule().scatterer_scale() * scatterers_[1][cell];
  return {std::move(plain), std::move(perturbed)};
}

}  // namespace lorentz
