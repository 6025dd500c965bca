/// Persistence mu(sigma): fraction of the scatterings that conserve the direction of the particle, p' p > 0,
/// over all particles and both directions.
///
/// In equilibrium mu = arccos(sigma)/pi [eq. 10], from which a finite chain deviates. For independent
/// particles and scatterers at the temperatures T_p and T_s, mu follows from the ratio of the temperatures
/// [eq. 11]. The mean energies before scatterings are stored to separate this part of the deviation from
/// correlations.
#include <cstdint>

#include "sampling/closed_run.hpp"

namespace {

using namespace lorentz;

struct Tallies : ClosedTallies {
  ScalarTally scatterings = tally("scatterings", "1", "Collisions of a particle with a scatterer");
  ScalarTally persistent = tally("persistent", "1", "Collisions with p' p > 0");
  ScalarTally particle_energy = tally("particle_energy", "energy", "Sum of u^2/2 before collisions");
  ScalarTally scatterer_energy = tally("scatterer_energy", "energy", "Sum of U^2/2 before collisions");
};

/// 1 if u' u > 0, else 0. The signs are compared, because the product could underflow, and without a branch,
/// because branch prediction fails for random signs.
std::uint64_t keeps_direction(double before, double after) {
  const auto positive = [](double u) { return std::uint64_t{u > 0}; };
  return (positive(before) & positive(after)) | (positive(-before) & positive(-after));
}

/// Sums over the scatterings of one replica.
struct Encounters {
  std::uint64_t scatterings = 0;
  std::uint64_t persistent = 0;
  double particle_energy = 0;
  double scatterer_energy = 0;

  void on_collision(const Collision& collision) {
    ++scatterings;
    persistent += keeps_direction(collision.particle_before, collision.particle_after);
    particle_energy += 0.5 * collision.particle_before * collision.particle_before;
    scatterer_energy += 0.5 * collision.scatterer_before * collision.scatterer_before;
  }
};

Study persistence(const ClosedParameters& parameters) {
  const Tallies tallies;
  const auto observe = [=](ClosedRun& run, Record& record) {
    Encounters sums;
    run.observe(sums);
    record[tallies.scatterings] = static_cast<double>(sums.scatterings);
    record[tallies.persistent] = static_cast<double>(sums.persistent);
    record[tallies.particle_energy] = sums.particle_energy;
    record[tallies.scatterer_energy] = sums.scatterer_energy;
  };
  Group group;
  group.quantity("mu", "1", "Fraction of scatterings with p' p > 0",
                 [=](RecordView mean) { return mean[tallies.persistent] / mean[tallies.scatterings]; });
  group.quantity("particle_energy", "energy", "Mean kinetic energy of a particle as it meets a scatterer",
                 [=](RecordView mean) { return mean[tallies.particle_energy] / mean[tallies.scatterings]; });
  group.quantity("scatterer_energy", "energy", "Mean kinetic energy of a scatterer as a particle meets it",
                 [=](RecordView mean) { return mean[tallies.scatterer_energy] / mean[tallies.scatterings]; });
  return closed_study(parameters, tallies, observe, {group}, "mu");
}

}  // namespace

int main(int argc, char** argv) {
  StudyProgram program("persistence",
                       "Probability that a particle keeps its direction when it scatters, in a closed chain");
  ClosedParameters parameters;
  declare(program.options(), parameters);
  return program.run(argc, argv, [&] { return persistence(parameters); });
}
