/// Persistence mu(sigma): fraction of the scatterings that conserve the direction of the particle, p' p > 0,
/// over all particles and both directions.
///
/// In equilibrium mu = arccos(sigma)/pi for elastic collisions [eq. 10]. In a finite chain the conservation
/// of the total momentum changes it [eq. 11], by an amount that follows from the temperature at which
/// particles and scatterers meet: their mean energies before scatterings are stored.
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "sampling/closed_run.hpp"

namespace {

using namespace lorentz;

/// 1 if u' u > 0, else 0. The signs are compared, because the product could underflow, and without a branch,
/// because branch prediction fails for random signs. A particle that arrives has u != 0.
int keeps_direction(double before, double after) {
  const auto one = std::bit_cast<std::uint64_t>(before), other = std::bit_cast<std::uint64_t>(after);
  return static_cast<int>(~(one ^ other) >> 63) & int{after != 0};
}

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

struct MeanOverScatterings {
  const char *name, *units, *description;
  double (*sum)(const Scatterings&);
};

constexpr std::array means{
    MeanOverScatterings{"mu", "1", "Fraction of scatterings with p' p > 0",
                        [](const Scatterings& sums) { return static_cast<double>(sums.keeping); }},
    MeanOverScatterings{"particle_energy", "energy",
                        "Mean kinetic energy of a particle as it meets a scatterer",
                        [](const Scatterings& sums) { return sums.particle_energy; }},
    MeanOverScatterings{"scatterer_energy", "energy",
                        "Mean kinetic energy of a scatterer as a particle meets it",
                        [](const Scatterings& sums) { return sums.scatterer_energy; }}};

struct Tallies : ClosedTallies {
  ScalarTally number = tally("number", "1", "Scatterings");
  std::vector<ScalarTally> sums;  // of the means

  Tallies() {
    for (const auto& mean : means) sums.push_back(tally(mean.name, mean.units, "Sum over scatterings"));
  }
};

Study persistence(const ClosedParameters& parameters) {
  validate(parameters);
  const Tallies tallies;
  const auto observe = [=](ClosedRun& run, TallySums& sums) {
    Scatterings scatterings;
    run.observe(scatterings);
    sums[tallies.number] = static_cast<double>(scatterings.number);
    for (std::size_t k = 0; k < means.size(); ++k) sums[tallies.sums[k]] = means[k].sum(scatterings);
  };
  Group group;
  for (std::size_t k = 0; k < means.size(); ++k)
    group.quantity(means[k].name, means[k].units, means[k].description,
                   [sum = tallies.sums[k], number = tallies.number](TallyMeans mean) {
                     return mean[sum] / mean[number];
                   });
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
