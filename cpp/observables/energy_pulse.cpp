/// Relaxation of an energy pulse: Delta E_i(t) = <E~_i(t) - E_i(t)> [eq. 42], the energy of cell i (its
/// scatterer and the particles inside) in a chain whose central cells are given more energy at t = 0 [eq.
/// 41], minus that in the same chain without the pulse.
///
/// The ring is folded about its centre by mirror symmetry [eq. 43] before the moving peak is fitted
/// (observables/energy_pulse/peak.hpp). At times without a peak, as before it leaves the centre, all
/// quantities of the peak are NaN, and fits use the other times. The same holds from the time on at which the
/// two sides of the pulse meet opposite to it, as a later peak may have gone around the ring. For gamma -> 0
/// the pulse is that of free flight [eq. 44].
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "observables/energy_pulse/moving_peak.hpp"
#include "observables/energy_pulse/pair.hpp"
#include "program/errors.hpp"
#include "sampling/closed_run.hpp"

namespace {

using namespace lorentz;

/// Defaults: figure 9a of the paper.
struct Parameters {
  ClosedChainParameters ring{.scattering = {.cells = 101}, .particles_per_cell = 50};
  double energy = 5000;         // per degree of freedom, T = 2 energy
  double pulse_energy = 50000;  // per degree of freedom in the pulse
  std::uint32_t pulse_cells = 1;
  std::optional<double> scatterer_temperature{};  // none: that of the particles
  double relaxation_time = 0;
  std::vector<double> times{0.01, 0.02, 0.03, 0.04, 0.05,
                            0.06, 0.08, 0.1,  0.12};  // before the peaks meet on the ring
  std::uint32_t pairs_per_replica = 16;

  ClosedParameters start() const {
    return {.ring = ring,
            .temperature = 2 * energy,
            .scatterer_temperature = scatterer_temperature.value_or(2 * energy),
            .relaxation_time = relaxation_time,
            .observation_time = 0};
  }
};

void declare(Options& options, Parameters& parameters) {
  declare(options, parameters.ring);
  options.real(Role::physics, "--energy", parameters.energy, positive, "energy",
               "Energy per degree of freedom at the start; the temperature is twice it");
  options.real(Role::physics, "--pulse-energy", parameters.pulse_energy, positive, "energy",
               "Energy per degree of freedom in the pulse");
  options.integer(Role::physics, "--pulse-cells", parameters.pulse_cells, {1, 100'000'000},
                  "Number of cells in the pulse, about the central one");
  options.real_or_word(
      Role::physics, "--scatterer-temperature", parameters.scatterer_temperature, non_negative, "particles",
      "temperature",
      "Temperature of the scatterers at the start; 0: at rest; particles: that of the particles");
  options.real(Role::physics, "--relaxation-time", parameters.relaxation_time, non_negative, "time",
               "Time before the pulse");
  options.ascending_list(Role::output, "--times", parameters.times, positive, "time",
                         "Times after the pulse");
  options.integer(Role::effort, "--pairs-per-replica", parameters.pairs_per_replica, {1, 1'000'000},
                  "Pairs of trajectories, with the pulse and without, that a replica averages over");
}

/// Throws UsageError if options that are valid one by one exclude each other.
void validate(const Parameters& parameters) {
  validate(parameters.start());
  if (const RuleProperties& rule = parameters.ring.scattering.rule.properties(); rule.changes_neighbour)
    throw UsageError(fmt::format(
        "--rule {} changes a neighbour, for which pairs of trajectories have no code. Choose another --rule.",
        rule.name));
  const double hottest = std::max(parameters.start().hottest(), 2 * parameters.pulse_energy);
  const ClosedChain chain = parameters.ring.chain();
  require_resolved(chain.cell_length / std::sqrt(hottest),
                   parameters.relaxation_time + parameters.times.back(),
                   "--cell-length, --relaxation-time, --times");
  if (parameters.pulse_energy <= parameters.energy)
    throw UsageError(fmt::format(
        "--pulse-energy {} does not exceed --energy {}: the pulse would take energy away, and no peak moves. "
        "Choose a higher one.",
        parameters.pulse_energy, parameters.energy));
  if (parameters.pulse_cells > chain.cells)
    throw UsageError(fmt::format("--pulse-cells {} exceeds --cells {}. Choose a smaller pulse.",
                                 parameters.pulse_cells, chain.cells));
  if (parameters.pulse_cells % 2 == 0)
    throw UsageError(fmt::format(
        "--pulse-cells {} is even: the pulse would not be symmetric about the central cell. Choose an odd "
        "number.",
        parameters.pulse_cells));
  if (chain.cells < 7)
    throw UsageError(fmt::format(
        "--cells {} is less than 7: a ring so short has no moving peak. Choose more cells.", chain.cells));
  if (parameters.times.size() < 2)
    throw UsageError("--times has one time: the damping exponent needs two. Add another.");
}

/// Number of the cell in which a particle is.
std::uint32_t cell_of(const Particle& particle, const ClosedChain& chain) {
  return std::min(static_cast<std::uint32_t>(particle.position / chain.cell_length), chain.cells - 1);
}

double energy(double velocity) { return 0.5 * velocity * velocity; }

double energy(const PhasePoint& point) {
  double sum = 0;
  for (const double U : point.scatterers) sum += energy(U);
  for (const Particle& particle : point.particles) sum += energy(particle.velocity);
  return sum;
}

double sum(const std::vector<double>& parts) { return std::accumulate(parts.begin(), parts.end(), 0.0); }

/// State with all momenta in the central cells multiplied by one factor [eq. 41].
PhasePoint with_pulse(PhasePoint point, const Parameters& parameters) {
  const ClosedChain chain = parameters.ring.chain();
  const std::uint32_t begin = chain.cells / 2 - parameters.pulse_cells / 2;
  const std::uint32_t end = begin + parameters.pulse_cells;
  std::vector<double*> inside;  // every velocity in the cells of the pulse
  for (std::uint32_t cell = begin; cell < end; ++cell) inside.push_back(&point.scatterers[cell]);
  for (Particle& particle : point.particles) {
    const std::uint32_t cell = cell_of(particle, chain);
    if (cell >= begin && cell < end) inside.push_back(&particle.velocity);
  }
  double before = 0;
  for (const double* velocity : inside) before += energy(*velocity);
  if (!(before > 0))
    throw NumericalError(
        "the cells of the pulse have no energy that could be scaled to --pulse-energy. Choose more "
        "--pulse-cells or --particles-per-cell.");
  const double factor = std::sqrt(static_cast<double>(inside.size()) * parameters.pulse_energy / before);
  for (double* velocity : inside) *velocity *= factor;
  return point;
}

/// Energy of every cell with the pulse minus that without, at the current time of both trajectories [eq. 42].
std::vector<double> energy_difference(const PairDynamics& pair, double time, const ClosedChain& chain) {
  std::vector<double> cells(chain.cells, 0);
  pair.for_each_diverged_particle(time, [&](std::uint32_t, const Particle& plain, const Particle& perturbed) {
    cells[cell_of(perturbed, chain)] += energy(perturbed.velocity);
    cells[cell_of(plain, chain)] -= energy(plain.velocity);
  });
  pair.for_each_diverged_scatterer([&](std::uint32_t cell, double plain, double perturbed) {
    cells[cell] += energy(perturbed) - energy(plain);
  });
  return cells;
}

struct Tallies : TallySchema {
  Axis time, cell;
  Tally energy_difference =
      tally("energy_difference", {time, cell}, "energy", "Energy per cell with the pulse minus without");
  ScalarTally injected_energy = tally("injected_energy", "energy", "Energy of the pulse");
  ScalarTally sum_error =
      tally("sum_error", "1", "Largest |sum over cells - injected energy| / total energy, mean over pairs");

  explicit Tallies(const Parameters& parameters)
      : time{"time", "time", "Time after the pulse", parameters.times},
        cell(numbered_axis("cell", "Cell number", parameters.ring.scattering.cells)) {}
};

/// One replica: means over its pairs of trajectories, with the pulse and without, that start from one state
/// and use common random numbers [eq. 41, eq. 42].
std::uint64_t average_pairs(const Parameters& parameters, const Tallies& tallies, const Replica& replica,
                            TallySums& sums) {
  const ClosedChain chain = parameters.ring.chain();
  const ClosedParameters before = parameters.start();
  const std::uint32_t pairs = parameters.pairs_per_replica;
  std::uint64_t events = 0;
  for (std::uint32_t number = 0; number < pairs; ++number) {
    const auto heartbeat = [&](double) { replica.heartbeat(static_cast<double>(number) / pairs); };
    heartbeat(0);  // a short pair may not call it itself
    const Replica of_pair{StreamKey(replica.key.seed, replica.key.replica * pairs + number), heartbeat};
    const auto [start, relaxation_events] = relaxed_start(before, of_pair);
    PairDynamics pair(chain, start, with_pulse(start, parameters), parameters.times.back(), of_pair.key);
    const double injected = sum(energy_difference(pair, 0, chain)), total = energy(start) + injected;
    double error = 0;
    for (std::size_t k = 0; k < parameters.times.size(); ++k) {
      pair.run(parameters.times[k], heartbeat);
      const std::vector<double> difference = energy_difference(pair, parameters.times[k], chain);
      for (std::size_t cell = 0; cell < difference.size(); ++cell)
        sums[tallies.energy_difference.row(k)][cell] += difference[cell] / pairs;
      error = std::max(error, std::abs(sum(difference) - injected) / total);
    }
    sums[tallies.injected_energy] += injected / pairs;
    sums[tallies.sum_error] += error / pairs;
    events += relaxation_events + pair.events();
  }
  return events;
}

/// At every time, 1 from the first one on at which the two sides of the pulse overlap where they meet: in the
/// mean over replicas the energy opposite to the pulse, over the largest energy of a cell, exceeds 2 %, or
/// the peak at its last speed has gone around half the ring, as it may pass between two times.
std::vector<double> ring_closed(const Records& records, const Tallies& tallies) {
  const std::vector<double> mean = records.mean();
  const std::size_t cells = tallies.cell.values.size();
  std::vector<double> closed;  // 0 or 1
  double speed = 0;            // in cells per time
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

/// Whether the energy of the pulse exceeds five of its standard errors: otherwise a peak is noise.
bool injected(const Records& records, const Tallies& tallies) {
  const Estimates energy =
      jackknife(records, [&](TallyMeans mean) { return std::vector{mean[tallies.injected_energy]}; });
  return !(energy.mean.front() <= 5 * energy.standard_error.front());
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
        return Estimates{ring_closed(records, tallies),
                         std::vector(times.size(), std::numeric_limits<double>::quiet_NaN())};
      });
  const std::vector<MovingPeak::Measured> measured = MovingPeak::quantities(tallies.time, distance, "energy");
  std::vector<Description> descriptions;
  for (const MovingPeak::Measured& quantity : measured) descriptions.push_back(quantity.what);
  group.quantities(descriptions, [=](const Records& records) {
    PeakWindows windows = peak_windows(records, tallies.energy_difference, times.size());
    const std::vector<double> closed = ring_closed(records, tallies);
    const bool significant = injected(records, tallies);
    for (std::size_t k = 0; k < times.size(); ++k)
      if (closed[k] == 1 || !significant) windows[k].reset();
    return [=](TallyMeans mean) {
      const MovingPeak peak(mean[tallies.energy_difference], times, mean[tallies.injected_energy], windows);
      std::vector<double> values;
      for (const MovingPeak::Measured& quantity : measured) {
        const std::vector<double> of_quantity = (peak.*quantity.values)();
        values.insert(values.end(), of_quantity.begin(), of_quantity.end());
      }
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

Study energy_pulse(const Parameters& parameters) {
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
  Parameters parameters;
  declare(program.options(), parameters);
  return program.run(argc, argv, [&] { return energy_pulse(parameters); });
}
