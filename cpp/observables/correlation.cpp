/// Correlations in space and time of the conserved densities in a closed chain that has relaxed from a
/// Gaussian start [eq. 54]: numbers n of particles, energies e and momenta g of the cells (scatterer and the
/// particles inside),
///
///   C_a(r, t) = <a_0(0) a_r(t)> - <a>^2,     a = n, e, g,
///
/// means over cells, over origins of time one first time of --times apart, and over replicas. No second
/// trajectory is needed, and the linear response to a small pulse follows from them. Of a fluid with three
/// conserved fields, sound spreads about +-ct and heat about 0 (Spohn, J. Stat. Phys. 154, 1191, 2014; for
/// hard-point chains Mendl and Spohn, Phys. Rev. E 90, 012147, 2014). The pressure is proportional to the
/// energy of the particles alone: heat changes n at constant pressure and is seen in C_n, whose value at r =
/// 0 is `centre`, while C_g has the sound peaks alone, whose height and exponents are `peak` and its like.
///
/// Sums over r are conserved: the variance of the total over the number of cells. So the fields are taken
/// relative to their measured means over the ring, and the variance of the total, known from the start, is
/// added [eq. 55].
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "observables/correlation/field_correlations.hpp"
#include "program/errors.hpp"
#include "sampling/closed_run.hpp"
#include "sampling/lags.hpp"
#include "sampling/limits.hpp"
#include "statistics/fit.hpp"
#include "statistics/moving_peak.hpp"

namespace {

using namespace lorentz;

struct Parameters : ClosedParameters {
  std::vector<double> times{0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1};

  Parameters() {
    ring.scattering.cells = 1001;
    ring.particles_per_cell = 50;
    temperature = scatterer_temperature = 10'000;
    relaxation_time = 1;
    observation_time = 2;
  }
};

struct Tallies : ClosedTallies {
  Axis time, cell;
  std::array<Tally, 3> fields{
      // by Conserved
      tally("number", {time, cell}, "1", "Covariance of the numbers of particles in two cells"),
      tally("energy", {time, cell}, "energy^2", "Covariance of the energies of two cells"),
      tally("momentum", {time, cell}, "momentum^2", "Covariance of the momenta of two cells")};

  explicit Tallies(const Parameters& parameters)
      : time{"time", "time", "Time between the two", parameters.times},
        cell(numbered_axis("cell", "Number of the cell; the other is in the middle of the ring",
                           parameters.ring.scattering.cells)) {}
};

void observe(const Parameters& parameters, const Tallies& tallies, ClosedRun& run, Record& record) {
  const double interval = parameters.times.front();
  const auto snapshots = static_cast<std::size_t>(parameters.observation_time / interval * (1 + 1e-9)) + 1;
  FieldCorrelations correlations(parameters, lags(parameters.times));
  NoObserver nobody;
  for (std::size_t j = 0; j < snapshots; ++j) {
    const double time = parameters.relaxation_time + static_cast<double>(j) * interval;
    run.observe_until(time, nobody);
    correlations.add(run.chain().phase_point(run.clock(time)));
  }
  for (std::size_t field = 0; field < tallies.fields.size(); ++field)
    for (std::size_t k = 0; k < parameters.times.size(); ++k)
      record.set(tallies.fields[field].row(k), correlations.profile(field, k));
}

Group profiles(const Tallies& tallies) {
  const std::size_t cells = tallies.cell.values.size(), times = tallies.time.values.size();
  const auto centre = [=](RecordView mean) {
    std::vector<double> values;
    for (std::size_t k = 0; k < times; ++k)
      values.push_back(mean[tallies.fields[Conserved::number].row(k)][cells / 2]);
    return values;
  };
  Group group;
  group.quantity("number_correlation", {tallies.time, tallies.cell}, "1",
                 "C_n(r, t): covariance of the numbers of particles in two cells",
                 mean_of(tallies.fields[Conserved::number]));
  group.quantity("energy_correlation", {tallies.time, tallies.cell}, "energy^2",
                 "C_e(r, t): covariance of the energies of two cells",
                 mean_of(tallies.fields[Conserved::energy]));
  group.quantity("momentum_correlation", {tallies.time, tallies.cell}, "momentum^2",
                 "C_g(r, t): covariance of the momenta of two cells",
                 mean_of(tallies.fields[Conserved::momentum]));
  group.quantity("centre", {tallies.time}, "1", "C_n(0, t), the height of the heat peak", centre);
  const Axis middle{"middle", "time", "Geometric middle of two neighbouring times",
                    geometric_middles(tallies.time.values)};
  group.quantity("local_centre_exponent", {middle}, "1", "-d ln centre / d ln t between two times",
                 [=](RecordView mean) { return decay_exponents(tallies.time.values, centre(mean)); });
  return group;
}

Group sound_peak(const Tallies& tallies) {
  const std::vector<double> times = tallies.time.values;
  const Tally profiles = tallies.fields[Conserved::momentum];
  Group group;
  group.quantities(MovingPeak::descriptions(tallies.time, "momentum^2"), [=](const Records& records) {
    return [=, windows = peak_windows(records, profiles, times.size())](RecordView mean) {
      return MovingPeak(mean[profiles], times, windows).values();
    };
  });
  return group;
}

Study correlation(const Parameters& parameters) {
  if (parameters.times.size() < 2)
    throw UsageError("--times has one time: the damping exponent needs two. Add another.");
  if (parameters.times.back() > parameters.observation_time)
    throw UsageError("--times goes beyond --observation-time. Choose a longer one, or earlier times.");
  if (parameters.chain().cells < 7)
    throw UsageError("--cells is less than 7: a ring so short has no moving peak. Choose more cells.");
  // Of every snapshot, the transforms of three fields are kept until the longest lag.
  require_record_size(3.0 * parameters.chain().cells * static_cast<double>(lags(parameters.times).back() + 1),
                      "--cells, --times");
  const Tallies tallies(parameters);
  return closed_study(parameters, tallies, std::bind_front(observe, parameters, tallies),
                      {profiles(tallies), sound_peak(tallies)}, "damping_exponent");
}

}  // namespace

int main(int argc, char** argv) {
  StudyProgram program("correlation",
                       "Space-time correlations of number, energy and momentum in a closed chain");
  Parameters parameters;
  declare(program.options(), parameters);
  program.options().ascending_list("--times", parameters.times, positive, "time",
                                   "Times between the two, multiples of the first");
  return program.run(argc, argv, [&] { return correlation(parameters); });
}
