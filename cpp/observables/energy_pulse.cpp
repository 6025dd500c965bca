/// Relaxation of an energy pulse: Delta E_i(t) = <E~_i(t) - E_i(t)> [eq. 44], the energy of cell i (its
/// scatterer and the particles inside) in a chain whose central cells are given more energy at t = 0 [eq.
/// 43], minus that in the same chain without the pulse.
///
/// The ring is folded about its centre by mirror symmetry [eq. 45] before the moving peak is fitted
/// (statistics/peak.hpp). At times without a peak, as before it leaves the centre, all quantities of the peak
/// are NaN, and fits use the other times. At gamma = 1 the result is compared with free flight [eq. 47].
#include <algorithm>
#include <cmath>
#include <functional>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "observables/energy_pulse/pulse_run.hpp"
#include "program/study.hpp"
#include "statistics/moving_peak.hpp"

namespace {

using namespace lorentz;

struct Tallies : TallySchema {
  Axis time, cell;
  Tally energy_difference =
      tally("energy_difference", {time, cell}, "energy", "Energy per cell with the pulse minus without");
  ScalarTally injected_energy = tally("injected_energy", "energy", "Energy of the pulse");
  ScalarTally sum_error =
      tally("sum_error", "1", "Largest |sum over cells - injected energy| / total energy");

  explicit Tallies(const PulseParameters& parameters)
      : time{"time", "time", "Time after the pulse", parameters.times},
        cell(numbered_axis("cell", "Cell number", parameters.ring.scattering.cells)) {}
};

/// One replica: means over its pairs of trajectories.
std::uint64_t average_pairs(const PulseParameters& parameters, const Tallies& tallies, const Replica& replica,
                            TallySums& sums) {
  const std::size_t cells = tallies.cell.values.size();
  const std::uint32_t pairs = parameters.pairs_per_replica;
  std::uint64_t events = 0;
  for (std::uint32_t pair = 0; pair < pairs; ++pair) {
    const auto heartbeat = [&](double) { replica.heartbeat(static_cast<double>(pair) / pairs); };
    heartbeat(0);  // a short pair may not call it itself
    PulseRun run(parameters, StreamKey(replica.key.seed, replica.key.replica * pairs + pair), heartbeat);
    double error = 0;
    for (std::size_t k = 0; k < parameters.times.size(); ++k) {
      run.run(parameters.times[k]);
      const std::vector<double> difference = run.energy_difference();
      for (std::size_t cell = 0; cell < cells; ++cell)
        sums[tallies.energy_difference.row(k)][cell] += difference[cell] / pairs;
      error = std::max(error, run.conservation_error(difference));
    }
    sums[tallies.injected_energy] += run.injected_energy() / pairs;
    sums[tallies.sum_error] += error / pairs;
    events += run.events();
  }
  return events;
}

Group spreading(const Tallies& tallies) {
  const std::vector<double> times = tallies.time.values;
  const Axis distance =
      numbered_axis("distance", "Cells from the central one", (tallies.cell.values.size() - 1) / 2, 1);
  Group group;
  group.quantity("energy_difference", {tallies.time, tallies.cell}, "energy",
                 "Energy per cell with the pulse minus without", mean_of(tallies.energy_difference));
  group.quantity("injected_energy", "energy", "Energy of the pulse",
                 [=](TallyMeans mean) { return mean[tallies.injected_energy]; });
  group.quantity("sum_error", "1",
                 "Largest |sum over cells - injected energy| / total energy, mean over pairs",
                 [=](TallyMeans mean) { return mean[tallies.sum_error]; });
  std::vector<Description> of_peak = MovingPeak::descriptions(tallies.time, "energy");
  of_peak.push_back(
      {"centre_share", "1", "Part of the injected energy in the central five cells", {tallies.time}});
  of_peak.push_back({"odd_part",
                     "energy",
                     "Half of right minus left side: 0 by mirror symmetry",
                     {tallies.time, distance}});
  group.quantities(of_peak, [=](const Records& records) {
    return [=, windows = peak_windows(records, tallies.energy_difference, times.size())](TallyMeans mean) {
      const MovingPeak peak(mean[tallies.energy_difference], times, windows);
      std::vector<double> values = peak.values();
      for (const auto& each : {peak.centre_shares(mean[tallies.injected_energy]), peak.odd_parts()})
        values.insert(values.end(), each.begin(), each.end());
      return values;
    };
  });
  return group;
}

Study energy_pulse(const PulseParameters& parameters) {
  validate(parameters);
  const Tallies tallies(parameters);
  return {.tallies = tallies,
          .sample = std::bind_front(average_pairs, parameters, tallies),
          .groups = {spreading(tallies)},
          .target = "damping_exponent"};
}

/// Keeps freed memory in the process for the next pair. By default glibc returns it to the system, and
/// allocating it again takes a quarter of the time at gamma = N.
void keep_freed_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
#endif
}

}  // namespace

int main(int argc, char** argv) {
  keep_freed_memory();
  StudyProgram program("energy_pulse", "Spreading of an energy pulse in a closed chain");
  PulseParameters parameters;
  declare(program.options(), parameters);
  return program.run(argc, argv, [&] { return energy_pulse(parameters); });
}
