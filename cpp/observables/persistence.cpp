/// Persistence mu(sigma): the fraction of scatterings after which a particle goes on in the direction
/// in which it came, p' p > 0, over all particles and both directions.
///
/// In equilibrium mu = arccos(sigma)/pi: the velocities that meet at a scatterer are Gaussian at one
/// temperature, with the flux weight |v| and density 1/|v| cancelling (closed form of the paper's
/// integral). A finite chain deviates. If particles and scatterers met at the temperatures T_p and T_s
/// but independently, mu would be 1/2 - arctan(sigma/sqrt(1-sigma^2) sqrt(T_p/T_s))/pi; the local mean
/// energies are stored so that this part of the deviation can be told from correlations.
#include <cstdint>

#include "observables/closed_chain_options.hpp"
#include "program/replica_study.hpp"

namespace {

using namespace lorentz;

/// 1 if u' u > 0, else 0, without the underflow of the product. Without branches, which could not be
/// predicted.
std::uint64_t keeps_direction(double before, double after) {
  const auto positive = [](double u) { return std::uint64_t{u > 0}; };
  return (positive(before) & positive(after)) | (positive(-before) & positive(-after));
}

/// Sums over the scatterings of one replica, before each collision.
struct Encounters {
  std::uint64_t scatterings = 0;
  std::uint64_t persistent = 0;
  double particle_energy = 0;   // sum of u^2/2
  double scatterer_energy = 0;  // sum of U^2/2

  void on_collision(const Collision& collision) {
    ++scatterings;
    persistent += keeps_direction(collision.particle_before, collision.particle_after);
    particle_energy += 0.5 * collision.particle_before * collision.particle_before;
    scatterer_energy += 0.5 * collision.scatterer_before * collision.scatterer_before;
  }
};

Results summarise(const Records& records) {
  return estimate(
      records,
      {{"mu", "1", "Fraction of scatterings with p' p > 0"},
       {"particle_energy", "energy", "Mean kinetic energy of a particle as it meets a scatterer"},
       {"scatterer_energy", "energy", "Mean kinetic energy of a scatterer as a particle meets it"}},
      [](std::span<const double> sums) {
        return std::vector{sums[1] / sums[0], sums[2] / sums[0], sums[3] / sums[0]};
      });
}

}  // namespace

int main(int argc, char** argv) {
  Program program("persistence",
                  "Probability that a particle keeps its direction when it scatters, in a closed chain");
  ClosedChainOptions chain;
  chain.declare(program.options());
  ReplicaOptions replicas(program);
  replicas.declare(program.options());
  return program.run(argc, argv, [&](Progress& progress) {
    chain.validate();
    const auto measure = [&](const Replica& replica) {
      ClosedReplica run(chain, replica);
      run.relax();
      Encounters sums;
      run.observe_until(chain.end_time(), sums);
      return run.record({static_cast<double>(sums.scatterings), static_cast<double>(sums.persistent),
                         sums.particle_energy, sums.scatterer_energy});
    };
    return replicas.run({measure, with_drift(summarise), "mu", RandomStream::description}, progress);
  });
}
