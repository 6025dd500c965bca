/// Ageing of the closed chain: mean energies of a scatterer and of a particle as functions of the time since
/// the end of the relaxation.
///
/// The invariant density of the particles, exp(-u^2/2T)/|u| [eq. 8], is not normalisable. The number of slow
/// particles keeps growing, and the energy that they lose heats the scatterers and the other particles
/// logarithmically in time [eq. 14]. The slope against ln t of the means over windows between neighbouring
/// times, in every decade and over the last --fit-decades decades, shows whether heating continues or
/// saturates. The total energy, whose mean over initial states is known, is a control variate [eq. 33].
#include <functional>

#include "sampling/closed_run.hpp"
#include "sampling/log_times.hpp"
#include "statistics/control_variates.hpp"
#include "statistics/fit.hpp"

namespace {

using namespace lorentz;

struct Parameters : ClosedParameters {
  LogTimeParameters log_times{.fit_decades = 2};

  Parameters() {
    relaxation_time = 0;
    observation_time = 10'000;
  }
  std::vector<double> times() const { return log_times.times(observation_time); }
};

struct Tallies : ClosedTallies {
  Axis time, window;
  Tally scatterer = tally("scatterer_energy", {time}, "energy", "Mean kinetic energy of a scatterer");
  Tally particle = tally("particle_energy", {time}, "energy", "Mean kinetic energy of a particle");
  Tally scatterer_window =
      tally("scatterer_energy_mean", {window}, "energy", "Mean kinetic energy of a scatterer over a window");
  ScalarTally total_energy = tally("total_energy", "1", "Total energy over its mean, minus 1; mean 0");

  explicit Tallies(const Parameters& parameters)
      : time{"time", "time", "Time since the end of the relaxation", parameters.times()},
        window{"window", "time", "Geometric middle of a window",
               parameters.log_times.grid(parameters.observation_time).middles()} {}
};

double scatterers_energy(const ClosedDynamics& chain) {
  double sum = 0;
  for (const double U : chain.scatterers()) sum += 0.5 * U * U;
  return sum;
}

/// Mean over a window of the energy of all scatterers: its value at the beginning plus every change weighted
/// by the remaining part of the window.
class WindowMean {
 public:
  WindowMean(const ClosedRun& run, double begin, double end)
      : run_(run), begin_(begin), end_(end), energy_(scatterers_energy(run.chain())) {}

  void on_collision(const Collision& collision) {
    const double before = collision.scatterer_before, after = collision.scatterer_after;
    changes_ += 0.5 * (after * after - before * before) * (run_.clock(end_) - collision.time);
  }

  double value() const { return energy_ + changes_ / (end_ - begin_); }

 private:
  const ClosedRun& run_;
  double begin_, end_;
  double energy_, changes_ = 0;
};

void observe(const Parameters& parameters, const Tallies& tallies, ClosedRun& run, TallySums& sums) {
  const ClosedChain chain = parameters.chain();
  const double cells = chain.cells, start = parameters.relaxation_time;
  double before = start;
  for (std::size_t k = 0; k < tallies.time.values.size(); ++k) {
    const double time = start + tallies.time.values[k];
    WindowMean mean(run, before, time);
    run.observe(mean, time);
    const double energy = scatterers_energy(run.chain());
    sums[tallies.scatterer][k] = energy / cells;
    sums[tallies.particle][k] = (run.chain().invariants().energy - energy) / chain.particles();
    if (k > 0) sums[tallies.scatterer_window][k - 1] = mean.value() / cells;
    before = time;
  }
  sums[tallies.total_energy] = run.energy_control();
}

Group energies(const Parameters& parameters, const Tallies& tallies) {
  const std::vector<double>& times = tallies.time.values;
  const std::vector<double> middles = tallies.window.values;
  Axis decade{"decade", "time", "First time of a decade", {}};
  constexpr std::size_t per_decade = LogTimeParameters::points_per_decade;
  for (std::size_t k = 0; k + per_decade < times.size(); k += per_decade) decade.values.push_back(times[k]);
  const double fit_from = parameters.log_times.fit_from(parameters.observation_time), last = times.back();

  const Columns measured = columns_of({tallies.scatterer, tallies.particle, tallies.scatterer_window});
  Group group([=](const Records& records) {
    return reduce_variance(records, {{measured, columns_of({tallies.total_energy})}});
  });
  for (const Tally each : {tallies.scatterer, tallies.particle, tallies.scatterer_window})
    group.quantity(tallies, each);
  group.quantity(
      "decade_slope", {decade}, "energy", "Slope of scatterer_energy_mean against ln t in a decade",
      [=](TallyMeans mean) {
        std::vector<double> slopes;
        for (const double first : decade.values)
          slopes.push_back(fit_logarithm(middles, mean[tallies.scatterer_window], first, 10 * first));
        return slopes;
      });
  group.quantity("log_slope", "energy", "The same over the last --fit-decades decades", [=](TallyMeans mean) {
    return fit_logarithm(middles, mean[tallies.scatterer_window], fit_from, last);
  });
  return group;
}

Study ageing(const Parameters& parameters) {
  validate(parameters);
  validate(parameters.log_times);
  const Tallies tallies(parameters);
  return closed_study(parameters, tallies, std::bind_front(observe, parameters, tallies),
                      {energies(parameters, tallies)}, "log_slope");
}

}  // namespace

int main(int argc, char** argv) {
  StudyProgram program("ageing", "Energy of the scatterers of a closed chain against time");
  Parameters parameters;
  declare(program.options(), parameters);
  declare(program.options(), parameters.log_times);
  return program.run(argc, argv, [&] { return ageing(parameters); });
}
