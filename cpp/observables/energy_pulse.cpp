/// Return to equilibrium of an energy pulse: Delta E_i(t) = <E~_i(t) - E_i(t)>, the energy of cell i (its
/// scatterer and the particles inside) in a chain whose central cells got more energy at t = 0, minus that in
/// the same chain without. Both trajectories start from one state and share all random numbers.
///
/// The pulse scales all momenta in the central --pulse-cells cells by one factor, so that their energy
/// becomes --pulse-energy per degree of freedom. The ring is folded about its centre (mirror symmetry) before
/// the moving peak is looked for (statistics/peak.hpp). Where there is none, as before it has left the
/// centre, everything that is read off it is NaN, and fits use the other times.
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>

#include "engine/pair.hpp"
#include "model/portable.hpp"
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

  std::uint32_t first_cell() const { return chain.cells / 2 - pulse_cells / 2; }
};

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

/// The start with the pulse on top of it.
PhasePoint with_pulse(PhasePoint point, const Pulse& pulse) {
  const std::uint32_t begin = pulse.first_cell(), end = begin + pulse.pulse_cells;
  std::vector<double*> inside;  // every velocity in the cells of the pulse
  for (std::uint32_t cell = begin; cell < end; ++cell) inside.push_back(&point.scatterers[cell]);
  for (Particle& particle : point.particles) {
    const std::uint32_t cell = cell_of(particle, pulse.chain);
    if (cell >= begin && cell < end) inside.push_back(&particle.velocity);
  }
  double before = 0;
  for (const double* velocity : inside) before += energy(*velocity);
  if (!(before > 0))
    throw NumericalError(
        "the cells of the pulse hold no energy that could be scaled. Choose more --pulse-cells or "
        "--particles-per-cell.");
  const double factor = std::sqrt(static_cast<double>(inside.size()) * pulse.pulse_energy / before);
  for (double* velocity : inside) *velocity *= factor;
  return point;
}

/// Energy of every cell in the perturbed trajectory minus that in the plain one: of what differs only.
std::vector<double> energy_difference(const PairDynamics& pair, double time, const ClosedChain& chain) {
  std::vector<double> cells(chain.cells, 0);
  pair.for_each_double_particle(time, [&](std::uint32_t, const Particle& plain, const Particle& perturbed) {
    cells[cell_of(perturbed, chain)] += energy(perturbed.velocity);
    cells[cell_of(plain, chain)] -= energy(plain.velocity);
  });
  pair.for_each_double_scatterer([&](std::uint32_t cell, double plain, double perturbed) {
    cells[cell] += energy(perturbed) - energy(plain);
  });
  return cells;
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
    const auto total = [](const std::vector<double>& parts) {
      return std::accumulate(parts.begin(), parts.end(), 0.0);
    };
    const double injected = total(energy_difference(pair, 0, pulse.chain));
    const double total_energy = energy(start) + injected;
    double error = 0;
    for (std::size_t k = 0; k < pulse.times.size(); ++k) {
      pair.run(pulse.times[k], heartbeat);
      const std::vector<double> difference = energy_difference(pair, pulse.times[k], pulse.chain);
      for (std::size_t cell = 0; cell < cells; ++cell)
        record.values[k * cells + cell] += difference[cell] / pulse.members;
      error = std::max(error, std::abs(total(difference) - injected) / total_energy);
    }
    record.values[pulse.times.size() * cells] += injected / pulse.members;
    record.values.back() += error / pulse.members;
    record.events += pair.events();
  }
  return record;
}

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Where the peak is sought at every time, if there is one.
using Windows = std::vector<std::optional<PeakWindow>>;

/// The mean profile of either side at every time.
std::vector<std::vector<double>> profiles(std::span<const double> sums, const Pulse& pulse) {
  std::vector<std::vector<double>> result;
  for (std::size_t k = 0; k < pulse.times.size(); ++k)
    result.push_back(folded(sums.subspan(k * pulse.chain.cells, pulse.chain.cells)));
  return result;
}

Peak peak_in(const std::optional<PeakWindow>& window, const std::vector<double>& profile) {
  return window ? fit_peak(profile, *window) : Peak{none, none};
}

/// Windows in which the mean over all replicas has a peak, and that over all but one, whichever it is.
Windows peak_windows(const Records& records, const Pulse& pulse) {
  Windows windows;
  for (const std::vector<double>& profile : profiles(records.mean(), pulse))
    windows.push_back(peak_window(profile));
  const Estimate heights = jackknife(records, [&](std::span<const double> sums) {
    const std::vector<std::vector<double>> sides = profiles(sums, pulse);
    std::vector<double> values;
    for (std::size_t k = 0; k < sides.size(); ++k) values.push_back(peak_in(windows[k], sides[k]).height);
    return values;
  });
  const std::vector<double>& known = records.size() > 1 ? heights.standard_error : heights.mean;
  for (std::size_t k = 0; k < windows.size(); ++k)
    if (std::isnan(known[k])) windows[k].reset();
  return windows;
}

/// Everything that is read off the mean profiles; the vectors at all times, or between neighbouring ones.
struct Reading {
  std::vector<double> position, height, raw_height, centre_share, odd_part;
  std::vector<double> speed, local_exponent, exponent_from;
  double peak_collapse = none;
};

/// Minus the slope of ln height against ln t over the times with a peak, from one of them on.
double exponent_from(std::size_t first, const std::vector<double>& times,
                     const std::vector<double>& heights) {
  std::vector<double> t, height;
  for (std::size_t k = first; k < times.size(); ++k) {
    if (std::isnan(heights[k])) continue;
    t.push_back(times[k]);
    height.push_back(heights[k]);
  }
  return t.size() < 2 ? none : -fit_power(t, height, t.front(), t.back());
}

/// xi of the profiles about their peaks, a quarter of the last one's distance to either side.
double peak_collapse(const std::vector<std::vector<double>>& sides, const std::vector<double>& times,
                     const std::vector<double>& positions) {
  std::vector<Profile> moving;
  double reach = 0;
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (std::isnan(positions[k])) continue;
    Profile profile{times[k], {}, sides[k]};
    for (std::size_t d = 0; d < sides[k].size(); ++d)
      profile.x.push_back(static_cast<double>(d) - positions[k]);
    moving.push_back(std::move(profile));
    reach = 0.25 * positions[k];
  }
  return moving.size() < 2 ? none : collapse_exponent(moving, -reach, reach);
}

Reading read(std::span<const double> sums, const Pulse& pulse, const Windows& windows) {
  const std::vector<double>& times = pulse.times;
  const double injected = sums[times.size() * pulse.chain.cells];
  const std::vector<std::vector<double>> sides = profiles(sums, pulse);
  Reading reading;
  for (std::size_t k = 0; k < times.size(); ++k) {
    const Peak peak = peak_in(windows[k], sides[k]);
    reading.position.push_back(peak.position);
    reading.height.push_back(peak.height);
    reading.raw_height.push_back(highest_value(sides[k]));
    reading.centre_share.push_back((sides[k][0] + 2 * (sides[k][1] + sides[k][2])) / injected);
    const std::vector<double> odd = odd_part(sums.subspan(k * pulse.chain.cells, pulse.chain.cells));
    reading.odd_part.insert(reading.odd_part.end(), odd.begin(), odd.end());
  }
  for (std::size_t k = 0; k + 1 < times.size(); ++k) {
    reading.speed.push_back((reading.position[k + 1] - reading.position[k]) / (times[k + 1] - times[k]));
    reading.local_exponent.push_back(-portable::log(reading.height[k + 1] / reading.height[k]) /
                                     portable::log(times[k + 1] / times[k]));
    reading.exponent_from.push_back(windows[k] ? exponent_from(k, times, reading.height) : none);
  }
  reading.peak_collapse = peak_collapse(sides, times, reading.position);
  return reading;
}

/// 0, 1, ... or from another number on.
std::vector<double> numbers(std::size_t count, double first) {
  std::vector<double> result(count);
  std::iota(result.begin(), result.end(), first);
  return result;
}

Results summarise(const Records& records, const Pulse& pulse) {
  const std::size_t cells = pulse.chain.cells;
  const std::vector<double>& times = pulse.times;
  std::vector<double> middles, logarithmic_middles;
  for (std::size_t k = 0; k + 1 < times.size(); ++k) {
    middles.push_back(0.5 * (times[k] + times[k + 1]));
    logarithmic_middles.push_back(std::sqrt(times[k]) * std::sqrt(times[k + 1]));
  }
  const Axis time{"time", "time", "Time after the pulse", times};
  const Axis cell{"cell", "1", "Cell number", numbers(cells, 0)};
  const Axis distance{"distance", "1", "Cells from the central one", numbers((cells - 1) / 2, 1)};
  const Axis middle{"middle", "time", "Middle of two neighbouring times", middles};
  const Axis logarithmic{"middle", "time", "Geometric middle of two neighbouring times", logarithmic_middles};
  const Axis from{"from", "time", "First time of the fit", {times.begin(), times.end() - 1}};
  const Windows windows = peak_windows(records, pulse);
  return estimate(
      records,
      {{"energy_difference", "energy", "Energy per cell with the pulse minus without", {time, cell}},
       {"injected_energy", "energy", "Energy of the pulse"},
       {"sum_error", "1", "Largest |sum over cells - injected energy| / total energy, mean over members"},
       {"peak_position", "1", "Distance of the moving peak from the centre, in cells", {time}},
       {"peak", "energy", "Height of the moving peak, by a fit of exp(cubic) above half of it", {time}},
       {"peak_raw", "energy", "Largest value of the folded profile, biased upwards by the noise", {time}},
       {"centre_share", "1", "Part of the injected energy in the central five cells", {time}},
       {"odd_part", "energy", "Half of right minus left side: 0 by mirror symmetry", {time, distance}},
       {"peak_speed", "1/time", "Cells per time by which peak_position moves between two times", {middle}},
       {"local_damping_exponent", "1", "-d ln peak / d ln t between two times", {logarithmic}},
       {"damping_exponent_from", "1", "Minus the slope of ln peak against ln t from a time on", {from}},
       {"damping_exponent", "1", "The same over all times that have a peak"},
       {"peak_collapse", "1", "Exponent xi that makes t^xi Delta E a function of (x - peak)/t^xi"}},
      [&](std::span<const double> sums) {
        const Reading reading = read(sums, pulse, windows);
        std::vector<double> values(sums.begin(), sums.end());
        for (const auto* column :
             {&reading.position, &reading.height, &reading.raw_height, &reading.centre_share,
              &reading.odd_part, &reading.speed, &reading.local_exponent, &reading.exponent_from})
          values.insert(values.end(), column->begin(), column->end());
        values.push_back(exponent_from(0, times, reading.height));
        values.push_back(reading.peak_collapse);
        return values;
      });
}

void validate(const Pulse& pulse) {
  const double hottest = std::max({2 * pulse.energy, 2 * pulse.pulse_energy, pulse.scatterer_temperature});
  require_possible(pulse.chain, hottest, pulse.relaxation_time + pulse.times.back(), flights_of_one_clock,
                   "--energy, --pulse-energy, --scatterer-temperature", "--relaxation-time plus --times");
  if (pulse.pulse_cells > pulse.chain.cells)
    throw UsageError("--pulse-cells exceeds --cells. Choose a smaller pulse.");
  if (pulse.pulse_cells % 2 == 0)
    throw UsageError(
        "--pulse-cells is even: the pulse would lie about no cell's centre. Choose an odd number.");
  if (pulse.chain.cells < 7)
    throw UsageError("--cells is less than 7: a moving peak needs room. Choose more cells.");
  if (pulse.times.size() < 2) throw UsageError("--times has one time: the damping needs two. Add another.");
}

/// Every member frees what the next one needs again. glibc would return it to the system in between, and
/// getting it back took a quarter of the time at gamma = N.
void keep_freed_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
#endif
}

}  // namespace

int main(int argc, char** argv) {
  keep_freed_memory();
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
