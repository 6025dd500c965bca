/// Relaxation of an energy pulse: Delta E_i(t) = <E~_i(t) - E_i(t)> [eq. 44], the energy of cell i (its
/// scatterer and the particles inside) in a chain whose central cells are given more energy at t = 0 [eq.
/// 43], minus that in the same chain without the pulse.
///
/// The ring is folded about its centre by mirror symmetry [eq. 45] before the moving peak is fitted
/// (statistics/peak.hpp). At times without a peak, as before it leaves the centre, all quantities of the peak
/// are NaN, and fits use the other times. The same holds from the time on at which the two sides of the pulse
/// meet opposite to it, as a later peak may have gone around the ring. At gamma = 1 the result is compared
/// with free flight [eq. 47].
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
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
      tally("sum_error", "1", "Largest |sum over cells - injected energy| / total energy, mean over pairs");

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

/// At every time, 1 from the first one on at which the two sides of the pulse overlap where they meet: in the
/// mean over replicas the energy opposite to the pulse, over the largest energy of a cell, exceeds 2 %, or
/// the peak at its last speed has gone around half the ring, as it may pass between two times.
std::vector<double> ring_closed(const Records& records, const Tallies& tallies) {
  const std::vector<double> mean = records.mean();
  const std::size_t cells = tallies.cell.values.size();
  std::vector<double> closed;
  double speed = 0;  // in cells per time
  for (std::size_t k = 0; k < tallies.time.values.size(); ++k) {
    const auto difference = TallyMeans(mean)[tallies.energy_difference.row(k)];
    const double opposite =
        (difference[0] + difference[1] + difference[cells - 2] + difference[cells - 1]) / 4;
    const bool before = k > 0 && closed[k - 1] == 1;
    const double time = tallies.time.values[k];
    const bool passed = speed * time > 0.5 * static_cast<double>(cells);
    closed.push_back(before || passed || opposite > 0.02 * std::ranges::max(difference) ? 1 : 0);
    if (const auto window = peak_window(folded(difference))) speed = window->middle / time;
  }
  return closed;
}

Group spreading(const Tallies& tallies) {
  const std::vector<double> times = tallies.time.values;
  const Axis distance =
      numbered_axis("distance", "Cells from the central one", (tallies.cell.values.size() - 1) / 2, 1);
  Group group;
  group.quantity(tallies, tallies.energy_difference);
  group.quantity(tallies, tallies.injected_energy);
  group.quantity(tallies, tallies.sum_error);
  group.statistics(
      {{"ring_closed", "1", "1: both sides of the pulse have met opposite to it", {tallies.time}}},
      [=](const Records& records) {
        return Estimate{ring_closed(records, tallies),
                        std::vector(times.size(), std::numeric_limits<double>::quiet_NaN())};
      });
  std::vector<Description> of_peak = MovingPeak::descriptions(tallies.time, "energy");
  of_peak.push_back(
      {"centre_share", "1", "Part of the injected energy in the central five cells", {tallies.time}});
  of_peak.push_back({"odd_part",
                     "energy",
                     "Half of right minus left side: 0 by mirror symmetry",
                     {tallies.time, distance}});
  group.quantities(of_peak, [=](const Records& records) {
    PeakWindows windows = peak_windows(records, tallies.energy_difference, times.size());
    const std::vector<double> closed = ring_closed(records, tallies);
    for (std::size_t k = 0; k < times.size(); ++k)
      if (closed[k] == 1) windows[k].reset();
    return [=](TallyMeans mean) {
      const MovingPeak peak(mean[tallies.energy_difference], times, windows);
      std::vector<double> values = peak.values();
      for (const auto& each : {peak.centre_shares(mean[tallies.injected_energy]), peak.odd_parts()})
        values.insert(values.end(), each.begin(), each.end());
      return values;
    };
  });
  return group;
}

std::vector<std::string> remarks(const std::vector<double>& times, const Results& results) {
  const std::vector<double>& closed = quantity_named(results, "ring_closed").mean;
  const auto first = std::ranges::find(closed, 1.0) - closed.begin();
  if (first == std::ssize(closed)) return {};
  return {fmt::format(
      "the pulse has gone around half the ring at the time {}: there is no peak from then on; choose more "
      "--cells, or earlier --times",
      times[static_cast<std::size_t>(first)])};
}

Study energy_pulse(const PulseParameters& parameters) {
  validate(parameters);
  const Tallies tallies(parameters);
  return {.tallies = tallies,
          .sample = std::bind_front(average_pairs, parameters, tallies),
          .groups = {spreading(tallies)},
          .target = "damping_exponent",
          .remarks = std::bind_front(remarks, parameters.times)};
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
