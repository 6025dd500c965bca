/// Spreading of a tagged particle: raw moments of the unwrapped displacement x(t) from the end of the
/// relaxation, <|x|^q> for q = 1, 2, 4, averaged over all particles, on a logarithmic grid of times.
///
/// The closed chain conserves the total momentum, and the paper's random start gives it a value of order
/// sqrt(nN T): the centre of mass of the particles drifts. Its part of <x^2> is stored beside it, as the
/// square of the mean displacement of a replica's particles; --zero-total-momentum removes the drift at
/// the root. The drift is the same for all particles of a replica and most of the noise. It follows the total
/// momentum, whose mean square is known and serves as a control variate; quantities named *_plain are those
/// without it. Three laws are compared over the last --fit-decades decades: t, t^alpha by the slope alpha of
/// ln <x^2> against ln t, and t/ln t by the power b in <x^2> ~ t ln(t/tau)^b, where tau is the time of a
/// thermal flight: alpha = 1 and b = 0 say t, b = -1 says t/ln t (waits ~ tau^-2 and unit steps), alpha > 1
/// and b > 0 superdiffusion. b is stored only where no common drift, which is neither, hides the laws.
#include <algorithm>
#include <cmath>
#include <limits>

#include "model/portable.hpp"
#include "observables/closed_chain_options.hpp"
#include "observables/log_times_options.hpp"
#include "observables/physics_options.hpp"
#include "program/replica_study.hpp"
#include "statistics/control_variates.hpp"
#include "statistics/fit.hpp"

namespace {

using namespace lorentz;

/// Net number of cells that every particle's targets have moved since the beginning.
struct Walk {
  std::vector<std::int64_t> cells;
  void on_flight(const Departure& departure) { cells[departure.particle] += departure.cells; }
};

/// Moments at one time, averaged over the particles.
struct Moments {
  double square = 0, absolute = 0, fourth = 0, mean = 0;
};

Moments moments(const std::vector<std::int64_t>& cells, const std::vector<double>& start,
                const std::vector<double>& now, double cell_length) {
  Moments sums;
  for (std::size_t i = 0; i < start.size(); ++i) {
    const double x = static_cast<double>(cells[i]) * cell_length + now[i] - start[i];
    sums.square += x * x;
    sums.absolute += std::abs(x);
    sums.fourth += x * x * x * x;
    sums.mean += x;
  }
  const auto particles = static_cast<double>(start.size());
  return {sums.square / particles, sums.absolute / particles, sums.fourth / particles, sums.mean / particles};
}

/// Square, absolute, fourth moment, squared mean and mean, each at all times; then the control.
ReplicaRecord measure(const ClosedChainOptions& options, const std::vector<double>& times,
                      const Replica& replica) {
  ClosedReplica run(options, replica);
  run.relax();
  const double begin = options.relaxation_time();
  const std::vector<double> start = run.chain().positions_from_targets(run.clock(begin));
  Walk walk{std::vector<std::int64_t>(start.size(), 0)};
  std::vector<double> sums(5 * times.size());
  for (std::size_t k = 0; k < times.size(); ++k) {
    run.observe_until(begin + times[k], walk);
    const Moments now =
        moments(walk.cells, start, run.chain().positions_from_targets(run.clock(begin + times[k])),
                options.chain().cell_length);
    sums[k] = now.square;
    sums[times.size() + k] = now.absolute;
    sums[2 * times.size() + k] = now.fourth;
    sums[3 * times.size() + k] = now.mean * now.mean;
    sums[4 * times.size() + k] = now.mean;
  }
  sums.push_back(run.momentum_control());
  return run.record(std::move(sums));
}

/// b of y ~ t ln(t/tau)^b, over the times from `from` on; NaN unless they exceed tau.
double logarithmic_power(const std::vector<double>& times, std::span<const double> y, double from,
                         double tau) {
  std::vector<double> log_time, log_ratio;
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (times[k] < from) continue;
    log_time.push_back(portable::log(times[k] / tau));
    log_ratio.push_back(y[k] / times[k]);
  }
  return fit_power(log_time, log_ratio, log_time.front(), log_time.back());
}

/// The grid of times and what belongs to it.
struct Grid {
  std::vector<double> times, middles;
  double fit_from;  // first time of the fits
  double tau;       // of a thermal flight over one cell
  bool drifts;      // the centre of mass, by a conserved total momentum
};

Results plain_spreading(const Records& records, const Grid& grid) {
  const std::size_t size = grid.times.size();
  const Axis time{"time", "time", "Time since the end of the relaxation", grid.times};
  return estimate(
      records,
      {{"variance_plain", "length^2", "<x^2>, without the control variate", {time}},
       {"alpha_plain", "1", "alpha, without the control variate"}},
      [&](std::span<const double> sums) {
        std::vector<double> values(sums.begin(), sums.begin() + static_cast<std::ptrdiff_t>(size));
        values.push_back(fit_power(grid.times, sums.first(size), grid.fit_from, grid.times.back()));
        return values;
      });
}

Results spreading(const ReducedRecords& records, const Grid& grid) {
  const std::vector<double>& times = grid.times;
  const std::size_t size = times.size();
  const Axis time{"time", "time", "Time since the end of the relaxation", times};
  const Axis middle{"time", "time", "Geometric middle of two neighbouring times", grid.middles};
  std::vector<Description> descriptions{
      {"variance", "length^2", "<x^2>, no mean subtracted", {time}},
      {"absolute_moment", "length", "<|x|>", {time}},
      {"fourth_moment", "length^4", "<x^4>", {time}},
      {"centre_of_mass", "length^2", "Mean square of the particles' mean displacement", {time}},
      {"mean_displacement", "length", "<x>; 0 by symmetry", {time}},
      {"local_slope", "1", "d ln <x^2> / d ln t", {middle}},
      {"alpha", "1", "Slope of ln <x^2> against ln t over the last --fit-decades decades"},
      {"alpha_relative", "1", "The same without the part of the centre of mass"},
      {"alpha_difference", "1", "alpha minus alpha_relative"}};
  if (!grid.drifts)
    descriptions.push_back(
        {"logarithmic_power", "1", "b of <x^2> ~ t ln(t/tau)^b over the same times: 0 for t, -1 for t/ln t"});
  return estimate(records, descriptions, [&](std::span<const double> sums) {
    std::vector<double> values(sums.begin(), sums.begin() + static_cast<std::ptrdiff_t>(5 * size));
    for (std::size_t k = 0; k + 1 < size; ++k)
      values.push_back(sums[k] > 0
                           ? portable::log(sums[k + 1] / sums[k]) / portable::log(times[k + 1] / times[k])
                           : std::numeric_limits<double>::quiet_NaN());
    std::vector<double> relative;
    for (std::size_t k = 0; k < size; ++k) relative.push_back(sums[k] - sums[3 * size + k]);
    const double alpha = fit_power(times, sums.first(size), grid.fit_from, times.back());
    const double alpha_relative = fit_power(times, relative, grid.fit_from, times.back());
    values.insert(values.end(), {alpha, alpha_relative, alpha - alpha_relative});
    if (!grid.drifts) values.push_back(logarithmic_power(times, sums.first(size), grid.fit_from, grid.tau));
    return values;
  });
}

/// From few replicas of a few particles a mean square may come out negative, which is worse than its noise.
ReducedRecords controlled(const Records& plain) {
  ReducedRecords reduced = reduce_variance(plain, 1);
  const std::vector<double> means = reduced.records.mean();
  const auto control = means.end() - 1;
  const auto signed_mean = control - static_cast<std::ptrdiff_t>((means.size() - 1) / 5);
  const bool possible = std::all_of(means.begin(), signed_mean, [](double moment) { return moment >= 0; });
  return possible ? reduced : ReducedRecords{plain, false};
}

Results summarise(const Records& plain, const Grid& grid) {
  Results results = spreading(controlled(plain), grid);
  for (Quantity& quantity : plain_spreading(plain, grid)) results.push_back(std::move(quantity));
  return results;
}

/// Throws UsageError unless the displacements at the first time and at the last have fourth powers, and the
/// first time is more than what the clock rounds.
void require_resolved(const ClosedChainOptions& options, double first_time) {
  const double speed = std::sqrt(options.temperature());
  const double shortest = first_time * speed, longest = options.observation_time() * speed;
  const std::string names = "--temperature, --observation-time, --decades";
  require_within(shortest, 1e-70, 1e70, names, "the displacement at the first time");
  require_within(longest, 1e-70, 1e70, names, "the displacement at the last time");
  require_within(options.chain().cell_length, 1e-70, 1e70, "--cell-length", "it");
  require_within(std::min(options.end_time(), options.longest_clock()) / first_time, 0, 1e12,
                 "--relaxation-time, --observation-time, --decades", "the clock over the first time");
}

}  // namespace

int main(int argc, char** argv) {
  Program program("displacement", "Spreading of a tagged particle in a closed chain");
  ClosedChainOptions chain(/*relaxation_time=*/100, /*observation_time=*/1000);
  chain.declare(program.options());
  chain.declare_random_direction(program.options());
  LogTimesOptions log_times(/*fit_decades=*/1);
  log_times.declare(program.options());
  ReplicaOptions replicas(program);
  replicas.declare(program.options());
  return program.run(argc, argv, [&](Progress& progress) {
    chain.validate();
    const double last = chain.observation_time();
    require_resolved(chain, log_times.times(last).front());
    const Grid grid{log_times.times(last), log_times.grid(last).middles(), log_times.fit_from(last),
                    chain.chain().cell_length / std::sqrt(chain.temperature()),
                    chain.mean_square_momentum() > 0 && !chain.chain().random_direction};
    const auto one = [&](const Replica& replica) { return measure(chain, grid.times, replica); };
    const auto results = [&](const Records& records) { return summarise(records, grid); };
    return replicas.run({one, with_drift(results), "alpha", RandomStream::description}, progress);
  });
}
