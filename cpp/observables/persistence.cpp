/// Persistence mu(sigma): fraction of the scatterings that conserve the direction of the particle, p' p > 0,
/// over all particles and both directions.
///
/// In equilibrium mu = arccos(sigma)/pi for elastic collisions [eq. 9]. In a finite chain the conservation
/// of the total momentum changes it [eq. 10], by an amount that follows from the temperature at which
/// particles and scatterers meet: their mean energies before scatterings are stored.
#include <bit>
#include <cstdint>

#include "sampling/closed_run.hpp"

namespace {

using namespace lorentz;

/// 1 if u' u > 0, else 0. The signs are compared, because the product could underflow, and without a branch,
/// because branch prediction fails for random signs. A particle that arrives has u != 0.
int keeps_direction(double before, double after) {
  const auto differing = std::bit_cast<std::uint64_t>(before) ^ std::bit_cast<std::uint64_t>(after);
  return static_cast<int>(~differing >> 63) & int{after != 0};
}

struct Tallies : ClosedTallies {
  ScalarTally number = tally("number", "1", "Scatterings");
  ScalarTally keeping = tally("keeping", "1", "Scatterings with p' p > 0");
  ScalarTally particle_energy = tally("particle_energy", "energy", "Sum over scatterings");
  ScalarTally scatterer_energy = tally("scatterer_energy", "energy", "Sum over scatterings");
};

/// Sums over scatterings.
struct Scatterings {
  std::int64_t number = 0, keeping = 0;
  double particle_energy = 0, scatterer_energy = 0;

  void on_collision(const Collision& collision) {
    ++number;
    keeping += keeps_direction(collision.particle_before, collision.particle_after);
    particle_energy += 0.5 * collision.particle_before * collision.particle_before;
    scatterer_energy += 0.5 * collision.scatterer_before * collision.scatterer_before;
  }
};

Study persistence(const ClosedParameters& parameters) {
  validate(parameters);
  const Tallies tallies;
  const auto observe = [=](ClosedRun& run, TallySums& sums) {
    Scatterings scatterings;
    run.observe(scatterings);
    sums[tallies.number] = static_cast<double>(scatterings.number);
    sums[tallies.keeping] = static_cast<double>(scatterings.keeping);
    sums[tallies.particle_energy] = scatterings.particle_energy;
    sums[tallies.scatterer_energy] = scatterings.scatterer_energy;
  };
  const auto per_scattering = [number = tallies.number](ScalarTally sum) {
    return [=](TallyMeans mean) { return mean[sum] / mean[number]; };
  };
  Group group;
  group.quantity("mu", "1", "Fraction of scatterings with p' p > 0", per_scattering(tallies.keeping));
  group.quantity("particle_energy", "energy", "Mean kinetic energy of a particle as it meets a scatterer",
                 per_scattering(tallies.particle_energy));
  group.quantity("scatterer_energy", "energy", "Mean kinetic energy of a scatterer as a particle meets it",
                 per_scattering(tallies.scatterer_energy));
  return closed_study(parameters, tallies, observe, {group}, "mu");
}

}  // namespace

int main(int argc, char** argv) {
  StudyProgram program("persistence",
                       "Probability that a particle keeps its direction when it scatters, in a closed chain");
  ClosedParameters parameters;
  declare(program.options(), parameters, Role::effort);
  return program.run(argc, argv, [&] { return persistence(parameters); });
}
