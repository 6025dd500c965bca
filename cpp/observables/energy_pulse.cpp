/// Return to equilibrium of an energy pulse: Delta E_i(t) = <E~_i(t) - E_i(t)>, the energy of cell i (its
/// scatterer and the particles inside) in a chain whose central cells got more energy at t = 0, minus that in
/// the same chain without. Both trajectories start from one state and share all random numbers.
///
/// The pulse scales all momenta in the central --pulse-cells cells by one factor, so that their energy
/// becomes --pulse-energy per degree of freedom. The ring is folded about its centre (mirror symmetry) before
/// the moving peak is looked for. A raw maximum over noisy cells is biased upwards, so position and height
/// are the top of a parabola fitted around it; both heights are stored.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "engine/pair.hpp"
#include "observables/closed_chain_options.hpp"
#include "observables/physics_options.hpp"
#include "program/errors.hpp"
#include "program/replica_study.hpp"
#include "statistics/collapse.hpp"
#include "statistics/fit.hpp"
#include "statistics/peak.hpp"

namespace {

using namespace lorentz;

using Heartbeat = std::function<void(double)>;

struct Pulse {
  ClosedChain chain{.cells = 101, .particles_per_cell = 50, .cell_length = 1};
  double energy = 5000;         // per degree of freedom, T = 2 energy
  double pulse_energy = 50000;  // the same in the pulse
  std::uint32_t pulse_cells = 1;
  double scatterer_temperature = -1;  // -1: that of the particles
  double relaxation_time = 0;
  std::vector<double> times{0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.08, 0.1, 0.12};  // peaks meet later
  std::uint32_t members = 16;
  bool separate = false;

  std::uint32_t first_cell() const { return (chain.cells - pulse_cells) / 2; }
};

std::uint32_t cell_of(const Particle& particle, const ClosedChain& chain) {
  return std::min(static_cast<std::uint32_t>(particle.position / chain.cell_length), chain.cells - 1);
}

std::vector<double> cell_energies(const PhasePoint& point, const ClosedChain& chain) {
  std::vector<double> energies;
  for (const double U : point.scatterers) energies.push_back(0.5 * U * U);
  for (const Particle& particle : point.particles)
    energies[cell_of(particle, chain)] += 0.5 * particle.velocity * particle.velocity;
  return energies;
}

/// The start with the pulse on top of it.
PhasePoint with_pulse(PhasePoint point, const Pulse& pulse) {
  const std::vector<double> energies = cell_energies(point, pulse.chain);
  const std::uint32_t begin = pulse.first_cell(), end = begin + pulse.pulse_cells;
  const auto inside = [&](std::uint32_t cell) { return cell >= begin && cell < end; };
  std::size_t degrees_of_freedom = pulse.pulse_cells;
  for (const Particle& particle : point.particles)
    degrees_of_freedom += inside(cell_of(particle, pulse.chain)) ? 1 : 0;
  const double before = std::accumulate(energies.begin() + begin, energies.begin() + end, 0.0);
  if (!(before > 0))
    throw NumericalError(
        "the cells of the pulse hold no energy that could be scaled. Choose more --pulse-cells or "
        "--particles-per-cell.");
  const double factor = std::sqrt(static_cast<double>(degrees_of_freedom) * pulse.pulse_energy / before);
  for (Particle& particle : point.particles)
    if (inside(cell_of(particle, pulse.chain))) particle.velocity *= factor;
  for (std::uint32_t cell = begin; cell < end; ++cell) point.scatterers[cell] *= factor;
  return point;
}

PhasePoint relaxed_start(const Pulse& pulse, const StreamKey& key, const Heartbeat& heartbeat,
                         std::uint64_t& events) {
  const double temperature = 2 * pulse.energy;
  const double of_scatterers = pulse.scatterer_temperature < 0 ? temperature : pulse.scatterer_temperature;
  PhasePoint start = closed_chain_start(pulse.chain, {temperature, of_scatterers}, false, key);
  if (pulse.relaxation_time == 0) return start;
  ClosedDynamics relaxing(pulse.chain, start, pulse.relaxation_time, key);
  NoObserver nobody;
  simulate(relaxing, pulse.relaxation_time, nobody, heartbeat);
  events += relaxing.events();
  return relaxing.phase_point(pulse.relaxation_time);
}

/// Means over the members of a replica: energy difference of every cell, time after time; the injected
/// energy; the largest |sum over cells - injected energy| / total energy.
ReplicaRecord measure(const Pulse& pulse, const Replica& replica) {
  const std::size_t cells = pulse.chain.cells;
  ReplicaRecord record{std::vector<double>(pulse.times.size() * cells + 2, 0), 0};
  for (std::uint32_t member = 0; member < pulse.members; ++member) {
    const Heartbeat heartbeat = [&](double) {
      replica.heartbeat(static_cast<double>(member) / pulse.members);
    };
    heartbeat(0);  // a member may be too short to ask by itself
    const StreamKey key(replica.key.seed, replica.key.replica * pulse.members + member);
    const PhasePoint start = relaxed_start(pulse, key, heartbeat, record.events);
    const PhasePoint pulsed = with_pulse(start, pulse);
    PairDynamics pair(pulse.chain, start, pulsed, pulse.times.back(), key, !pulse.separate);
    const auto energies = [&](const PhasePoint& point) { return cell_energies(point, pulse.chain); };
    const auto total = [](const std::vector<double>& parts) {
      return std::accumulate(parts.begin(), parts.end(), 0.0);
    };
    const double total_energy = total(energies(pulsed));
    const double injected = total_energy - total(energies(start));
    double error = 0;
    for (std::size_t k = 0; k < pulse.times.size(); ++k) {
      pair.run(pulse.times[k], heartbeat);
      const auto [plain, perturbed] = pair.phase_points(pulse.times[k]);
      std::vector<double> difference = energies(perturbed);
      const std::vector<double> without = energies(plain);
      for (std::size_t cell = 0; cell < cells; ++cell) {
        difference[cell] -= without[cell];
        record.values[k * cells + cell] += difference[cell] / pulse.members;
      }
      error = std::max(error, std::abs(total(difference) - injected) / total_energy);
    }
    record.values[pulse.times.size() * cells] += injected / pulse.members;
    record.values.back() += error / pulse.members;
    record.events += pair.events();
  }
  return record;
}

/// Everything that is read off the mean profiles, each at all times.
struct Reading {
  std::vector<double> position, height, raw_height, centre_share, exponent_from;
  double peak_collapse = 0, centre_collapse = 0;
};

/// highest: cells about which the peaks are sought.
Reading read(std::span<const double> sums, const Pulse& pulse, const std::vector<std::size_t>& highest) {
  const std::size_t cells = pulse.chain.cells;
  const double injected = sums[pulse.times.size() * cells];
  Reading reading;
  std::vector<std::vector<double>> profiles;
  for (std::size_t k = 0; k < pulse.times.size(); ++k) {
    profiles.push_back(folded(sums.subspan(k * cells, cells)));
    const Peak peak = moving_peak(profiles.back(), highest[k]);
    reading.position.push_back(peak.position);
    reading.height.push_back(peak.height);
    reading.raw_height.push_back(peak.raw_height);
    reading.centre_share.push_back((profiles.back()[0] + 2 * (profiles.back()[1] + profiles.back()[2])) /
                                   injected);
  }
  for (std::size_t k = 0; k + 1 < pulse.times.size(); ++k)
    reading.exponent_from.push_back(
        -fit_power(pulse.times, reading.height, pulse.times[k], pulse.times.back()));
  std::vector<Profile> moving, resting;
  for (std::size_t k = 0; k < pulse.times.size(); ++k) {
    Profile about_peak{pulse.times[k], {}, profiles[k]}, about_centre = about_peak;
    for (std::size_t d = 0; d < profiles[k].size(); ++d) {
      about_peak.x.push_back(static_cast<double>(d) - reading.position[k]);
      about_centre.x.push_back(static_cast<double>(d));
    }
    moving.push_back(std::move(about_peak));
    resting.push_back(std::move(about_centre));
  }
  const double reach = 0.25 * reading.position.back();
  reading.peak_collapse = collapse_exponent(moving, -reach, reach);
  reading.centre_collapse = collapse_exponent(resting, 0, reach);
  return reading;
}

Results summarise(const Records& records, const Pulse& pulse) {
  const std::size_t times = pulse.times.size(), cells = pulse.chain.cells;
  std::vector<std::size_t> highest;
  const std::vector<double> mean = records.mean();
  for (std::size_t k = 0; k < times; ++k)
    highest.push_back(highest_cell(folded(std::span(mean).subspan(k * cells, cells))));
  std::vector<double> cell_numbers(cells);
  std::iota(cell_numbers.begin(), cell_numbers.end(), 0.0);
  const Axis time{"time", "time", "Time after the pulse", pulse.times};
  const Axis cell{"cell", "1", "Cell number", cell_numbers};
  const Axis from{"from", "time", "First time of the fit", {pulse.times.begin(), pulse.times.end() - 1}};
  return estimate(
      records,
      {{"energy_difference", "energy", "Energy per cell with the pulse minus without", {time, cell}},
       {"injected_energy", "energy", "Energy of the pulse"},
       {"sum_error", "1", "Largest |sum over cells - injected energy| / total energy, mean over members"},
       {"peak_position", "1", "Distance of the moving peak from the centre, in cells", {time}},
       {"peak", "energy", "Height of the moving peak, by the parabola", {time}},
       {"peak_raw", "energy", "Largest value of the folded profile, biased upwards", {time}},
       {"centre_share", "1", "Part of the injected energy in the central five cells", {time}},
       {"damping_exponent_from", "1", "Minus the slope of ln peak against ln t from a time on", {from}},
       {"damping_exponent", "1", "The same over all times"},
       {"peak_collapse", "1", "Exponent xi that makes t^xi Delta E a function of (x - peak)/t^xi"},
       {"centre_collapse", "1", "Exponent xi that makes t^xi Delta E a function of x/t^xi about the centre"}},
      [&](std::span<const double> sums) {
        const Reading reading = read(sums, pulse, highest);
        std::vector<double> values(sums.begin(), sums.end());
        for (const auto* column : {&reading.position, &reading.height, &reading.raw_height,
                                   &reading.centre_share, &reading.exponent_from})
          values.insert(values.end(), column->begin(), column->end());
        values.insert(values.end(),
                      {reading.exponent_from.front(), reading.peak_collapse, reading.centre_collapse});
        return values;
      });
}

void validate(const Pulse& pulse) {
  const double hottest = std::max({2 * pulse.energy, 2 * pulse.pulse_energy, pulse.scatterer_temperature});
  require_possible(pulse.chain, hottest, pulse.relaxation_time + pulse.times.back(), flights_of_one_clock,
                   "--energy, --pulse-energy, --scatterer-temperature", "--relaxation-time plus --times");
  if (pulse.pulse_cells > pulse.chain.cells)
    throw UsageError("--pulse-cells exceeds --cells. Choose a smaller pulse.");
  if (pulse.chain.cells < 7)
    throw UsageError("--cells is less than 7: a moving peak needs room. Choose more cells.");
  if (pulse.times.size() < 2) throw UsageError("--times has one time: the damping needs two. Add another.");
}

}  // namespace

int main(int argc, char** argv) {
  Program program("energy_pulse", "Spreading of an energy pulse in a closed chain");
  Options& options = program.options();
  Pulse pulse;
  add_chain_options(options, pulse.chain);
  options.real("--energy", pulse.energy, positive,
               "Energy per degree of freedom at the start; the temperature is twice it");
  options.real("--pulse-energy", pulse.pulse_energy, positive, "Energy per degree of freedom in the pulse");
  options.integer("--pulse-cells", pulse.pulse_cells, {1, 100'000'000},
                  "Number of cells in the pulse, about the central one");
  options.real_or_word(
      "--scatterer-temperature", pulse.scatterer_temperature, non_negative, "particles", -1,
      "Temperature of the scatterers at the start; 0: at rest; particles: that of the particles");
  options.real("--relaxation-time", pulse.relaxation_time, non_negative, "Time before the pulse");
  options.ascending_list("--times", pulse.times, positive, "Times after the pulse");
  options.integer("--members", pulse.members, {1, 1'000'000}, "Pairs of trajectories per replica");
  options.flag("--separate", pulse.separate, "Simulate both trajectories in full; the result is the same",
               Options::Role::conduct);
  ReplicaOptions replicas(program);
  replicas.declare(options);
  return program.run(argc, argv, [&](Progress& progress) {
    validate(pulse);
    const auto one = [&](const Replica& replica) { return measure(pulse, replica); };
    const auto results = [&](const Records& records) { return summarise(records, pulse); };
    return replicas.run({one, results, "damping_exponent", RandomStream::description}, progress);
  });
}
