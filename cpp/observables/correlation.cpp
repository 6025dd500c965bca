/// Correlations in space and time of a closed chain in the stationary state [eq. 54]: of the momenta g of the
/// cells (a scatterer and the particles from there to the next one), which show sound, and of E_s - theta
/// E_p, the energies of scatterer and particles with theta = 1/(2 zeta), which show heat,
///
///   C_a(r, t) = <a_0(0) a_r(t)>,  <a> = 0,
///
/// means over cells, over origins of time one first time of --times apart, and over replicas. Mode coupling
/// predicts both peaks without a free parameter [eqs. M19, M29]:
///
///   C_g: at r = +-ct the peaks rho T/2 (lambda_s t)^(-2/3) f_KPZ, of an area rho T/2 each;
///   C of E_s - theta E_p: at r = 0 a Levy density of order 5/3. Frozen particles and, for many slow
///   particles, sound do not contribute.
///
/// Sums of C_g over r are conserved: they are the variance of the total momentum over the number of cells.
/// Each ring's own square of the total is replaced by its exact mean, a constant for all r [eq. 55].
///
/// Particles slower than the cut of the start are missing there and form in the run, at the expense of the
/// others. The peaks are too low by 0.03 % (docs/mode_coupling.md).
///
/// Sound must not travel around the ring within the longest time.

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "model/rules/elastic.hpp"
#include "observables/correlation/cell_fields.hpp"
#include "observables/correlation/ring_correlation.hpp"
#include "observables/correlation/sound_peak.hpp"
#include "program/errors.hpp"
#include "sampling/closed_run.hpp"
#include "sampling/equilibrium_parameters.hpp"
#include "statistics/moving_peak.hpp"

namespace {

using namespace lorentz;

struct Parameters : EquilibriumParameters {
  Parameters() : EquilibriumParameters({2, 4, 8, 16, 32, 64}) {}

  double root_mass() const { return Elastic(ring.scattering.sigma).root_mass(); }

  /// Variance of the total momentum over the number of cells [eq. 55].
  double momentum_variance() const {
    const StationaryMeasure measure = stationary_measure();
    const double cut = 0.5 * measure.slowest * measure.slowest / temperature;
    return temperature * (2 * zeta() * std::exp(-cut) + root_mass() * root_mass());
  }
};

struct Tallies : ClosedTallies {
  Axis time, cell;
  Tally momentum = tally("momentum_correlation", {time, cell}, "momentum^2",
                         "C_g(r, t): covariance of the momenta of two cells");
  Tally heat =
      tally("heat_correlation", {time, cell}, "energy^2", "Covariance of E_s - E_p/(2 zeta) of two cells");

  explicit Tallies(const Parameters& parameters)
      : time{"time", "time", "Time between the two", parameters.times},
        cell(numbered_axis("cell", "Number of the cell; the other is in the middle of the ring",
                           parameters.ring.scattering.cells)) {}
};

/// Momenta of all cells, with their scatterers.
std::vector<double> momenta(const CellFields& particles, const std::vector<double>& scatterers,
                            double root_mass) {
  std::vector<double> field = particles.momenta();
  for (std::size_t cell = 0; cell < field.size(); ++cell) field[cell] += root_mass * scatterers[cell];
  return field;
}

/// E_s - theta E_p of all cells.
std::vector<double> heat_field(const CellFields& particles, const std::vector<double>& scatterers,
                               double theta) {
  std::vector<double> field = particles.energies();
  for (std::size_t cell = 0; cell < field.size(); ++cell)
    field[cell] = 0.5 * scatterers[cell] * scatterers[cell] - theta * field[cell];
  return field;
}

/// The value at r = 0 moves to the middle of the ring.
std::vector<double> centred(std::vector<double> profile) {
  std::ranges::rotate(profile, profile.end() - static_cast<std::ptrdiff_t>(profile.size() / 2));
  return profile;
}

void observe(const Parameters& parameters, const Tallies& tallies, ClosedRun& run, TallySums& sums) {
  const ClosedChain chain = parameters.chain();
  const double interval = parameters.times.front(), cells = chain.cells;
  const std::vector<std::size_t> lags = lorentz::lags(parameters.times);
  RingCorrelation momentum(chain.cells, lags), heat(chain.cells, lags);
  const double total = run.chain().invariants().momentum;
  CellFields particles(run.chain().phase_point(0), chain);
  const std::size_t intervals = parameters.intervals(lags);
  for (std::size_t j = 0; j <= intervals; ++j) {
    run.observe(particles, std::min(static_cast<double>(j) * interval, parameters.end_time()));
    const std::vector<double> scatterers = run.chain().scatterers();
    momentum.add(momenta(particles, scatterers, parameters.root_mass()));
    heat.add(heat_field(particles, scatterers, 0.5 / parameters.zeta()));
  }
  const double correction = (parameters.momentum_variance() - total * total / cells) / cells;
  for (std::size_t k = 0; k < lags.size(); ++k) {
    std::vector<double> profile = centred(momentum.at(k));
    for (double& value : profile) value += correction;
    sums.set(tallies.momentum.row(k), profile);
    sums.set(tallies.heat.row(k), centred(heat.at(k)));
  }
}

/// A formula for every time, of that time's profile.
template <class Formula>
auto at_every_time(Tally profiles, std::size_t times, Formula formula) {
  return [=](TallyMeans mean) {
    std::vector<double> values;
    for (std::size_t k = 0; k < times; ++k) values.push_back(formula(mean[profiles.row(k)], k));
    return values;
  };
}

/// Distances in cells at a time: half that of sound, and that beyond which sound has not come, three
/// root-mean-square widths from the top of its peak, where f_KPZ is 0.8 % of its height.
struct Range {
  double half, end;

  Range(const Parameters& parameters, double time) {
    const Sound sound = Sound::of(parameters);
    const double way = sound.speed * time, width = sound.reach(time) - way;
    half = 0.5 * way / parameters.ring.cell_length;
    end = (way + 3 * width) / parameters.ring.cell_length;
  }
};

Group profiles(const Parameters& parameters, const Tallies& tallies) {
  const std::vector<double> times = tallies.time.values;
  std::vector<Range> ranges;
  for (const double time : times) ranges.emplace_back(parameters, time);
  const auto area = [=](std::span<const double> profile, std::size_t k) {
    return side_moment(profile, 0, ranges[k].half, ranges[k].end);
  };
  const auto centroid = [=](std::span<const double> profile, std::size_t k) {
    return side_moment(profile, 1, ranges[k].half, ranges[k].end) / area(profile, k);
  };
  const auto heat_area = [=](std::span<const double> profile, std::size_t k) {
    return 2 * side_moment(profile, 0, 0, ranges[k].half);
  };
  const auto centroids = at_every_time(tallies.momentum, times.size(), centroid);
  Group group;
  group.quantity(tallies, tallies.momentum);
  group.quantity(tallies, tallies.heat);
  group.quantity("peak_area", {tallies.time}, "momentum^2",
                 "Sum of C_g from half the distance of sound on, on one side",
                 at_every_time(tallies.momentum, times.size(), area));
  group.quantity("centroid", {tallies.time}, "1",
                 "Centre of mass of C_g over the same distances, in cells; NaN if no cell is there",
                 centroids);
  group.quantity("sound_speed", {middles(times)}, "1/time",
                 "Cells per time by which it moves between two times",
                 [=](TallyMeans mean) { return speeds(times, centroids(mean)); });
  group.quantity("heat_area", {tallies.time}, "energy^2",
                 "Sum of heat_correlation up to half the distance of sound, on both sides",
                 at_every_time(tallies.heat, times.size(), heat_area));
  return group;
}

Group sound_peak(const Parameters& parameters, const Tallies& tallies) {
  const std::vector<double> times = tallies.time.values;
  std::vector<double> half_widths;  // in cells [eq. M18]
  for (const double time : times) {
    constexpr double of_f_kpz = 0.880466;  // where f_KPZ is half of its maximum
    const double unit = std::pow(Sound::of(parameters).self_coupling * time, 2. / 3);
    half_widths.push_back(of_f_kpz * unit / parameters.ring.cell_length);
  }
  std::vector<Description> descriptions = MovingPeak::descriptions(tallies.time, "momentum^2");
  descriptions.push_back(
      {"peak_width", "1", "Full width of the peak at half its height, in cells", {tallies.time}});
  Group group;
  group.quantities(descriptions, [=, profiles = tallies.momentum](const Records& records) {
    return [=, windows = peak_windows(records, profiles, times.size())](TallyMeans mean) {
      const MovingPeak peak(mean[profiles], times, windows);
      std::vector<double> values = peak.values();
      for (std::size_t k = 0; k < times.size(); ++k)
        values.push_back(half_height_width(folded(mean[profiles.row(k)]), peak.positions()[k],
                                           peak.heights()[k], half_widths[k]));
      return values;
    };
  });
  return group;
}

/// Throws UsageError.
void require_consistent(const Parameters& parameters) {
  const std::vector<double>& times = parameters.times;
  if (times.size() < 2)
    throw UsageError("--times has one time: the damping exponent needs two. Add another.");
  if (!parameters.conserves_momentum())
    throw UsageError(
        "--rule, --sigma: momentum is not conserved, and there is no sound. Choose --rule elastic, and "
        "--sigma below 1.");
  const double least = std::max(7.0, std::ceil(2 * Range(parameters, times.back()).end));
  require_before_sound_returns(parameters, least);
}

Study correlation(const Parameters& parameters) {
  validate(parameters);
  require_consistent(parameters);
  const Tallies tallies(parameters);
  return closed_study(parameters, tallies, std::bind_front(observe, parameters, tallies),
                      {profiles(parameters, tallies), sound_peak(parameters, tallies)}, "damping_exponent");
}

}  // namespace

int main(int argc, char** argv) {
  StudyProgram program("correlation", "Sound and heat peaks in the correlations of a closed chain");
  Parameters parameters;
  declare(program.options(), parameters, "Times between the two, multiples of the first");
  return program.run(argc, argv, [&] { return correlation(parameters); });
}
