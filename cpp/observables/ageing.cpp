/// Ageing of the closed chain: the mean energy of a scatterer, and of a particle, against time from the
/// start.
///
/// The invariant density of the particles, exp(-u^2/2T)/|u|, cannot be normalised: ever more of them slow
/// down, and the energy that they lose heats the scatterers and the rest, logarithmically in time. Whether
/// that goes on or saturates is read off means over the windows between neighbouring times: their slope
/// against ln t, decade by decade, and over the last --fit-decades decades. The total energy, whose mean over
/// starts is known, is a control variate (statistics/control_variates.hpp).
#include "model/portable.hpp"
#include "observables/closed_chain_options.hpp"
#include "observables/log_times_options.hpp"
#include "program/replica_study.hpp"
#include "statistics/control_variates.hpp"
#include "statistics/fit.hpp"

namespace {

using namespace lorentz;

double scatterers_energy(const ClosedDynamics& chain) {
  double sum = 0;
  for (const double U : chain.scatterers()) sum += 0.5 * U * U;
  return sum;
}

/// Mean over a window of the energy of all scatterers: that at its beginning, and every change for the part
/// of the window that is left.
class WindowMean {
 public:
  WindowMean(const ClosedReplica& run, double begin, double end)
      : run_(run), begin_(begin), end_(end), energy_(scatterers_energy(run.chain())) {}

  void on_collision(const Collision& collision) {
    const double before = collision.scatterer_before, after = collision.scatterer_after;
    changes_ += 0.5 * (after * after - before * before) * (run_.clock(end_) - collision.time);
  }

  double value() const { return energy_ + changes_ / (end_ - begin_); }

 private:
  const ClosedReplica& run_;
  double begin_, end_;
  double energy_, changes_ = 0;
};

/// Energies per scatterer and per particle at every time, per scatterer over every window between two times;
/// then the control.
ReplicaRecord measure(const ClosedChainOptions& options, const std::vector<double>& times,
                      const Replica& replica) {
  ClosedReplica run(options, replica);
  run.relax();
  const double cells = options.chain().cells, start = options.relaxation_time();
  std::vector<double> scatterer, particle, window;
  double before = start;
  for (const double time : times) {
    WindowMean mean(run, before, start + time);
    run.observe_until(start + time, mean);
    const double energy = scatterers_energy(run.chain());
    scatterer.push_back(energy / cells);
    particle.push_back((run.chain().invariants().energy - energy) / options.chain().particles());
    if (before > start) window.push_back(mean.value() / cells);
    before = start + time;
  }
  for (const std::vector<double>& more : {particle, window, {run.energy_control()}})
    scatterer.insert(scatterer.end(), more.begin(), more.end());
  return run.record(std::move(scatterer));
}

/// Slope against ln t of the part of y whose times lie in [from, to].
double log_slope(const std::vector<double>& times, std::span<const double> y, double from, double to) {
  std::vector<double> log_time, part;
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (times[k] < from || times[k] > to) continue;
    log_time.push_back(portable::log(times[k]));
    part.push_back(y[k]);
  }
  return fit_line(log_time, part).slope;
}

/// Times of the record, geometric middles of the windows between them, and first times of the decades.
struct Grid {
  std::vector<double> times, middles, decades;
  double fit_from;
};

Results summarise(const Records& records, const Grid& grid) {
  const std::size_t size = grid.times.size();
  const Axis time{"time", "time", "Time since the start", grid.times};
  const Axis window{"window", "time", "Geometric middle of a window", grid.middles};
  const Axis decade{"decade", "time", "First time of a decade", grid.decades};
  return estimate(
      reduce_variance(records, 1),
      {{"scatterer_energy", "energy", "Mean kinetic energy of a scatterer", {time}},
       {"particle_energy", "energy", "Mean kinetic energy of a particle", {time}},
       {"scatterer_energy_mean", "energy", "Mean kinetic energy of a scatterer over a window", {window}},
       {"decade_slope", "energy", "Slope of scatterer_energy_mean against ln t in a decade", {decade}},
       {"log_slope", "energy", "The same over the last --fit-decades decades"}},
      [&](std::span<const double> sums) {
        const std::span<const double> means = sums.subspan(2 * size, size - 1);
        std::vector<double> values(sums.begin(), sums.end() - 1);
        for (const double first : grid.decades)
          values.push_back(log_slope(grid.middles, means, first, 10 * first));
        values.push_back(log_slope(grid.middles, means, grid.fit_from, grid.times.back()));
        return values;
      });
}

}  // namespace

int main(int argc, char** argv) {
  Program program("ageing", "Energy of the scatterers of a closed chain against time");
  ClosedChainOptions chain(/*relaxation_time=*/0, /*observation_time=*/10'000);
  chain.declare(program.options());
  LogTimesOptions log_times(/*fit_decades=*/2);
  log_times.declare(program.options());
  ReplicaOptions replicas(program);
  replicas.declare(program.options());
  return program.run(argc, argv, [&](Progress& progress) {
    chain.validate();
    const double last = chain.observation_time();
    Grid grid{log_times.times(last), log_times.grid(last).middles(), {}, log_times.fit_from(last)};
    for (std::size_t k = 0; k + LogTimesOptions::points_per_decade < grid.times.size();
         k += LogTimesOptions::points_per_decade)
      grid.decades.push_back(grid.times[k]);
    const auto one = [&](const Replica& replica) { return measure(chain, grid.times, replica); };
    const auto results = [&](const Records& records) { return summarise(records, grid); };
    return replicas.run({one, with_drift(results), "log_slope", RandomStream::description}, progress);
  });
}
