#include "observables/energy_pulse/pulse_run.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "engine/closed_dynamics.hpp"
#include "engine/closed_start.hpp"
#include "program/errors.hpp"

namespace lorentz {
namespace {

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

/// State with all momenta in the central cells multiplied by one factor [eq. 43].
PhasePoint with_pulse(PhasePoint point, const PulseParameters& parameters) {
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

}  // namespace

PulseRun::Start PulseRun::start(const PulseParameters& parameters, const StreamKey& key,
                                const Heartbeat& heartbeat) {
  const ClosedChain chain = parameters.ring.chain();
  const double temperature = 2 * parameters.energy, time = parameters.relaxation_time;
  Start start{closed_chain_start(chain, {temperature, parameters.scatterer_temperature.value_or(temperature)},
                                 false, key),
              {},
              0};
  if (time > 0) {
    ClosedDynamics relaxing(chain, start.plain, time, key);
    NoObserver nobody;
    simulate(relaxing, time, nobody, heartbeat);
    start.events = relaxing.events();
    start.plain = relaxing.phase_point(time);
  }
  start.pulsed = with_pulse(start.plain, parameters);
  return start;
}

PulseRun::PulseRun(const PulseParameters& parameters, const StreamKey& key, const Heartbeat& heartbeat,
                   bool share)
    : PulseRun(parameters, key, heartbeat, share, start(parameters, key, heartbeat)) {}

PulseRun::PulseRun(const PulseParameters& parameters, const StreamKey& key, Heartbeat heartbeat, bool share,
                   const Start& start)
    : chain_(parameters.ring.chain()),
      heartbeat_(std::move(heartbeat)),
      relaxation_events_(start.events),
      pair_(chain_, start.plain, start.pulsed, parameters.times.back(), key, share),
      injected_energy_(sum(energy_difference())),
      total_energy_(energy(start.plain) + injected_energy_) {}

void PulseRun::run(double time) {
  pair_.run(time, heartbeat_);
  time_ = time;
}

std::vector<double> PulseRun::energy_difference() const {
  std::vector<double> cells(chain_.cells, 0);
  pair_.for_each_diverged_particle(time_,
                                   [&](std::uint32_t, const Particle& plain, const Particle& perturbed) {
                                     cells[cell_of(perturbed, chain_)] += energy(perturbed.velocity);
                                     cells[cell_of(plain, chain_)] -= energy(plain.velocity);
                                   });
  pair_.for_each_diverged_scatterer([&](std::uint32_t cell, double plain, double perturbed) {
    cells[cell] += energy(perturbed) - energy(plain);
  });
  return cells;
}

double PulseRun::conservation_error(const std::vector<double>& energy_difference) const {
  return std::abs(sum(energy_difference) - injected_energy_) / total_energy_;
}

void declare(Options& options, PulseParameters& parameters) {
  declare(options, parameters.ring);
  options.real("--energy", parameters.energy, positive, "energy",
               "Energy per degree of freedom at the start; the temperature is twice it");
  options.real("--pulse-energy", parameters.pulse_energy, positive, "energy",
               "Energy per degree of freedom in the pulse");
  options.integer("--pulse-cells", parameters.pulse_cells, {1, 100'000'000},
                  "Number of cells in the pulse, about the central one");
  options.real_or_word(
      "--scatterer-temperature", parameters.scatterer_temperature, non_negative, "particles", "temperature",
      "Temperature of the scatterers at the start; 0: at rest; particles: that of the particles");
  options.real("--relaxation-time", parameters.relaxation_time, non_negative, "time",
               "Time before the pulse");
  options.ascending_list("--times", parameters.times, positive, "time", "Times after the pulse");
  options.integer("--pairs-per-replica", parameters.pairs_per_replica, {1, 1'000'000},
                  "Pairs of trajectories, with the pulse and without, that a replica averages over");
}

void validate(const PulseParameters& parameters) {
  validate(parameters.ring.scattering);
  const double of_scatterers = parameters.scatterer_temperature.value_or(0);
  const double hottest = std::max({2 * parameters.energy, 2 * parameters.pulse_energy, of_scatterers});
  const ClosedChain chain = parameters.ring.chain();
  require_memory(1.0 * chain.cells * chain.particles_per_cell, "--cells, --particles-per-cell");
  require_resolved(chain.cell_length / std::sqrt(hottest),
                   parameters.relaxation_time + parameters.times.back(),
                   "--cell-length, --relaxation-time, --times");
  if (parameters.pulse_cells > chain.cells)
    throw UsageError("--pulse-cells exceeds --cells. Choose a smaller pulse.");
  if (parameters.pulse_cells % 2 == 0)
    throw UsageError(
        "--pulse-cells is even: the pulse would not be symmetric about the central cell. Choose an odd "
        "number.");
  if (chain.cells < 7)
    throw UsageError("--cells is less than 7: a ring so short has no moving peak. Choose more cells.");
  if (parameters.times.size() < 2)
    throw UsageError("--times has one time: the damping exponent needs two. Add another.");
}

}  // namespace lorentz
