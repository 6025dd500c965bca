/// Persistence mu(sigma): fraction of the scatterings that conserve the direction of the particle, p' p > 0,
/// over all particles and both directions.
///
/// In equilibrium mu = arccos(sigma)/pi for elastic collisions [eq. 10], from which a finite chain deviates.
/// For independent particles and scatterers at the temperatures T_p and T_s, mu follows from the ratio of the
/// temperatures [eq. 11]. The mean energies before scatterings are stored to separate this part of the
/// deviation from correlations.
#include <bit>

#include "sampling/closed_averages.hpp"

namespace {

using namespace lorentz;

/// 1 if u' u > 0, else 0. The signs are compared, because the product could underflow, and without a branch,
/// because branch prediction fails for random signs. A particle that arrives has u != 0.
int keeps_direction(double before, double after) {
  const auto one = std::bit_cast<std::uint64_t>(before), other = std::bit_cast<std::uint64_t>(after);
  return static_cast<int>(~(one ^ other) >> 63) & int{after != 0};
}

struct Encounters : Averages {
  Average mu{this, "mu", "1", "Fraction of scatterings with p' p > 0"};
  Average particle_energy{this, "particle_energy", "energy",
                          "Mean kinetic energy of a particle as it meets a scatterer"};
  Average scatterer_energy{this, "scatterer_energy", "energy",
                           "Mean kinetic energy of a scatterer as a particle meets it"};

  explicit Encounters(const ClosedParameters&) {}

  void on_collision(const Collision& collision) {
    mu += keeps_direction(collision.particle_before, collision.particle_after);
    particle_energy += 0.5 * collision.particle_before * collision.particle_before;
    scatterer_energy += 0.5 * collision.scatterer_before * collision.scatterer_before;
    count();
  }
};

}  // namespace

int main(int argc, char** argv) {
  return run_closed_averages<Encounters>(
      argc, argv, "persistence",
      "Probability that a particle keeps its direction when it scatters, in a closed chain", "mu");
}
