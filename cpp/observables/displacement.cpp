/// Displacement of a tagged particle: <x^2> of the unwrapped displacement x(t) since the end of the
/// relaxation, averaged over all particles, on a logarithmic grid of times.
///
/// The closed chain conserves the total momentum [eq. 3]. A random initial state gives it a value
/// of order sqrt(nN T), and the centre of mass of the particles drifts [eq. 20, eq. 21]. The square of the
/// mean displacement of a replica's particles is stored; its subtraction does not restore diffusion [eq. 22],
/// whereas --zero-total-momentum removes the drift itself. The drift is common to all particles of a replica
/// and dominates the noise. It is correlated with the total momentum, whose mean square is known, so that it
/// is a control variate [eq. 32].
///
/// Over the last --fit-decades decades alpha is the slope of ln <x^2> against ln t [eq. 18]: 1 is diffusion,
/// more is superdiffusion, and t/ln t has less; it depends on the age of the chain [eq. 14, eq. 19]. Where
/// momentum is not conserved, by the collision rule or at sigma = 1, there is neither drift nor control
/// variate.
#include <algorithm>
#include <cmath>
#include <functional>

#include "observables/displacement/log_times.hpp"
#include "sampling/closed_run.hpp"
#include "statistics/control_variates.hpp"
#include "statistics/fit.hpp"

namespace {

using namespace lorentz;

struct Parameters : ClosedParameters {
  LogTimeParameters log_times;

  Parameters() { observation_time = 1000; }
  std::vector<double> times() const { return log_times.times(observation_time); }
};

struct Tallies : ClosedTallies {
  Axis time;
  Tally square = tally("mean_square_displacement", {time}, "length^2", "<x^2>, no mean subtracted");
  Tally centre_square =
      tally("mean_square_drift", {time}, "length^2", "Mean square of the particles' mean displacement");
  ScalarTally momentum_square =
      tally("momentum_square", "1", "Square of the total momentum over its mean, minus 1; mean 0");

  explicit Tallies(const std::vector<double>& times)
      : time{"time", "time", "Time since the end of the relaxation", times} {}
};

/// Means over particles of the displacement x and of its square.
struct Displacement {
  double square = 0, mean = 0;
};

/// Observer that follows the displacement of every particle of a closed run, unwrapped from the ring, from
/// the time `since` on.
class TaggedParticles {
 public:
  TaggedParticles(const ClosedRun& run, double since, double cell_length)
      : run_(run),
        cell_length_(cell_length),
        start_(run.chain().positions_from_targets(run.clock(since))),
        cells_(start_.size(), 0) {}

  void on_flight(const Departure& departure) { cells_[departure.particle] += departure.cells; }

  /// The displacement at `time`, to which the run has advanced.
  Displacement displacement(double time) const {
    const std::vector<double> now = run_.chain().positions_from_targets(run_.clock(time));
    Displacement sums;
    for (std::size_t i = 0; i < start_.size(); ++i) {
      const double x = static_cast<double>(cells_[i]) * cell_length_ + now[i] - start_[i];
      sums.square += x * x;
      sums.mean += x;
    }
    const auto particles = static_cast<double>(start_.size());
    return {sums.square / particles, sums.mean / particles};
  }

 private:
  const ClosedRun& run_;
  double cell_length_;
  std::vector<double> start_;        // positions relative to the target
  std::vector<std::int64_t> cells_;  // cells by which the target has moved since then
};

void observe(const Parameters& parameters, const Tallies& tallies, ClosedRun& run, TallySums& sums) {
  const double begin = parameters.relaxation_time;
  TaggedParticles particles(run, begin, parameters.ring.cell_length);
  for (std::size_t k = 0; k < tallies.time.values.size(); ++k) {
    const double time = begin + tallies.time.values[k];
    run.observe(particles, time);
    const Displacement mean = particles.displacement(time);
    sums[tallies.square][k] = mean.square;
    sums[tallies.centre_square][k] = mean.mean * mean.mean;
  }
  sums[tallies.momentum_square] = run.momentum_control();
}

/// Plain records replace corrected ones if a corrected mean of squares is negative, as may happen with few
/// replicas of few particles.
Group::Prepared controlled(const Records& plain, const Tallies& tallies) {
  const Columns squares = columns_of({tallies.square, tallies.centre_square});
  Group::Prepared reduced = reduce_variance(plain, {{squares, columns_of({tallies.momentum_square})}});
  const std::vector<double> means = reduced.records.mean();
  const bool possible = std::ranges::all_of(squares, [&](std::size_t column) { return means[column] >= 0; });
  return possible ? reduced : Group::Prepared{plain, ControlVariates{0, reduced.control_variates->needed}};
}

std::vector<Group> spreading(const Parameters& parameters, const Tallies& tallies) {
  const std::vector<double> times = tallies.time.values;
  const Axis middle{"time", "time", "Geometric middle of two neighbouring times", geometric_middles(times)};
  const double fit_from = parameters.log_times.fit_from(times.back());
  const auto alpha = [=](TallyMeans mean) {
    return fit_power(times, mean[tallies.square], fit_from, times.back());
  };

  Group group([=](const Records& records) { return controlled(records, tallies); });
  for (const Tally tally : {tallies.square, tallies.centre_square}) group.quantity(tallies, tally);
  group.quantity("local_slope", {middle}, "1", "d ln <x^2> / d ln t",
                 [=](TallyMeans mean) { return local_exponents(times, mean[tallies.square]); });
  group.quantity("alpha", "1", "Slope of ln <x^2> against ln t over the last --fit-decades decades", alpha);
  return {group};
}

Study displacement(const Parameters& parameters) {
  validate(parameters);
  validate(parameters.log_times);
  require_resolved(parameters.times().front(), std::min(parameters.end_time(), parameters.longest_clock()),
                   "--relaxation-time, --observation-time, --decades");
  const Tallies tallies(parameters.times());
  return closed_study(parameters, tallies, std::bind_front(observe, parameters, tallies),
                      spreading(parameters, tallies), "alpha");
}

}  // namespace

int main(int argc, char** argv) {
  StudyProgram program("displacement", "Spreading of a tagged particle in a closed chain");
  Parameters parameters;
  declare(program.options(), parameters, Role::output);
  declare(program.options(), parameters.log_times);
  return program.run(argc, argv, [&] { return displacement(parameters); });
}
