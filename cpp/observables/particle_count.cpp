/// Particles inside an open chain that starts empty: their number n(t), and their momentum distribution
/// n_t(p) times |p| at given times.
///
/// The stationary density F(p)/|p| cannot be normalised: n_t(p) |p| is stationary above a front p_0(t) only,
/// and n(t) grows with the logarithm of time, by L (F(0+) + F(0-)) per unit of ln t, where L is the length of
/// the chain. The front is where |p| n_t(p), on logarithmic bins, has fallen to half of its value above.
#include <algorithm>
#include <cmath>
#include <limits>

#include "model/portable.hpp"
#include "observables/momentum_bins_options.hpp"
#include "observables/open_chain_options.hpp"
#include "program/errors.hpp"
#include "program/replica_study.hpp"
#include "statistics/fit.hpp"
#include "statistics/log_grid.hpp"

namespace {

using namespace lorentz;

constexpr std::size_t bins_per_decade = 8, times_per_decade = 8;
constexpr double decades_of_time = 3;

/// Shows every particle inside at given times.
class Snapshots {
 public:
  explicit Snapshots(const std::vector<double>& times) : times_(times), next_time_(times.front()) {}

  /// Calls see(k) for every time of the flight. Departures come in the order of time.
  template <class See>
  void show(const Path& path, See&& see) {
    if (!(next_time_ < path.arrival)) [[likely]]
      return;
    while (next_ < times_.size() && times_[next_] < path.departure) ++next_;
    for (std::size_t k = next_; k < times_.size() && times_[k] < path.arrival; ++k) see(k);
    next_time_ = next_ < times_.size() ? times_[next_] : std::numeric_limits<double>::infinity();
  }

 private:
  const std::vector<double>& times_;
  std::size_t next_ = 0;
  double next_time_;  // times_[next_]
};

/// The times and bins of the counts.
struct Plan {
  std::vector<double> times;  // of the momentum distributions
  Bins bins;
  LogGrid speed_grid;          // bins of |p|
  std::vector<double> speeds;  // their edges
  LogGrid time_grid;
  std::vector<double> number_times;
  double cell_length;

  Plan(const std::vector<double>& snapshot_times, const Bins& linear, double length_of_cell)
      : times(snapshot_times),
        bins(linear),
        // From a tenth of the last front on, which is about one cell in the longest time.
        speed_grid(
            0.1 * length_of_cell / times.back(),
            std::max(1., portable::log10(10 * bins.edge(bins.count()) * times.back() / length_of_cell)),
            bins_per_decade),
        speeds(speed_grid.points()),
        time_grid(times.back() * portable::pow(10, -decades_of_time), decades_of_time, times_per_decade),
        number_times(time_grid.points()),
        cell_length(length_of_cell) {
    number_times.back() = times.back();
  }
};

/// At every time of the plan the sum of |p| by linear bins, and the number by logarithmic bins; the total
/// number at every time of its grid.
class Census {
 public:
  explicit Census(const Plan& plan)
      : plan_(plan),
        at_times_(plan.times),
        at_number_times_(plan.number_times),
        linear_(plan.times.size(), Histogram(plan.bins)),
        logarithmic_(plan.times.size(), std::vector<double>(plan.speed_grid.intervals(), 0)),
        number_(plan.number_times.size(), 0) {}

  void on_flight(const Path& path) {
    at_times_.show(path, [&](std::size_t k) {
      const double p = std::abs(path.velocity);
      linear_[k].add(path.velocity, p);
      if (p >= plan_.speeds.front() && p < plan_.speeds.back())
        logarithmic_[k][plan_.speed_grid.interval(p)] += 1;
    });
    at_number_times_.show(path, [&](std::size_t k) { number_[k] += 1; });
  }

  std::vector<double> record() const {
    std::vector<double> values;
    for (const Histogram& histogram : linear_)
      values.insert(values.end(), histogram.weights().begin(), histogram.weights().end());
    for (const std::vector<double>& counts : logarithmic_)
      values.insert(values.end(), counts.begin(), counts.end());
    values.insert(values.end(), number_.begin(), number_.end());
    return values;
  }

 private:
  const Plan& plan_;
  Snapshots at_times_, at_number_times_;
  std::vector<Histogram> linear_;
  std::vector<std::vector<double>> logarithmic_;
  std::vector<double> number_;
};

/// Mean of |p| n_t(p) over the bins between 10 cells per t and a fifth of the thermal momentum.
double plateau(std::span<const double> density, const Plan& plan, double time, double thermal) {
  const std::vector<double> middles = plan.speed_grid.middles();
  double sum = 0, bins = 0;
  for (std::size_t i = 0; i < middles.size(); ++i) {
    if (middles[i] < 10 * plan.cell_length / time || middles[i] > 0.2 * thermal) continue;
    sum += density[i];
    bins += 1;
  }
  return sum / bins;
}

/// Where |p| n_t(p) first rises through half of the plateau, on a straight line in ln |p|; NaN if nowhere.
double front(std::span<const double> density, const Plan& plan, double plateau) {
  const std::vector<double> middles = plan.speed_grid.middles();
  for (std::size_t i = 0; i + 1 < middles.size(); ++i) {
    if (density[i] > 0.5 * plateau || density[i + 1] <= 0.5 * plateau) continue;
    const double part = (0.5 * plateau - density[i]) / (density[i + 1] - density[i]);
    return middles[i] * portable::pow(middles[i + 1] / middles[i], part);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

Results summarise(const Records& records, const Plan& plan, double thermal) {
  const Axis time{"time", "time", "Time from the start", plan.times};
  const Axis momentum{"p", "momentum", "Middle of the bin", plan.bins.middles()};
  const Axis speed{"speed", "momentum", "|p|, geometric middle of the bin", plan.speed_grid.middles()};
  const Axis number_time{"time", "time", "Time from the start", plan.number_times};
  const Axis between{"time", "time", "Geometric middle of two neighbouring times", plan.time_grid.middles()};
  const std::size_t times = plan.times.size();
  const std::size_t linear = times * plan.bins.count(), speeds = plan.speed_grid.intervals();
  const double log_width = portable::log(plan.speeds[1] / plan.speeds[0]);
  return estimate(
      records,
      {{"weighted_momentum_density",
        "1",
        "|p| n_t(p), n_t being particles per unit momentum",
        {time, momentum}},
       {"weighted_speed_density", "1", "|p| n_t(p), both signs, on logarithmic bins", {time, speed}},
       {"total_number", "1", "Particles inside", {number_time}},
       {"number_slope", "1", "d n / d ln t", {between}},
       {"log_slope", "1", "Slope of n against ln t from the first of --times on"},
       {"log_curvature", "1", "Slope of dn/d ln t against ln t over the same times; 0 if n ~ ln t"},
       {"plateau", "1", "|p| n_t(p) above the front, both signs: what dn/d ln t should be", {time}},
       {"front", "momentum", "p_0(t): where |p| n_t(p) has fallen to half of the plateau", {time}},
       {"front_exponent", "1", "Slope of ln p_0 against ln t"}},
      [&](std::span<const double> row) {
        std::vector<double> values;
        for (std::size_t i = 0; i < linear; ++i) values.push_back(row[i] / plan.bins.width());
        for (std::size_t i = linear; i < linear + times * speeds; ++i) values.push_back(row[i] / log_width);
        const std::vector<double> densities(values.begin() + static_cast<std::ptrdiff_t>(linear),
                                            values.end());
        const std::span<const double> number = row.subspan(linear + times * speeds);
        values.insert(values.end(), number.begin(), number.end());
        std::vector<double> log_time, late_number, slope_time, late_slope;
        const double first_late = plan.times.front() * (1 - 1e-9);  // a little less than a point of the grid
        for (std::size_t k = 0; k < number.size(); ++k) {
          const bool late = plan.number_times[k] >= first_late;
          if (late) log_time.push_back(portable::log(plan.number_times[k]));
          if (late) late_number.push_back(number[k]);
          if (k + 1 == number.size()) break;
          values.push_back((number[k + 1] - number[k]) /
                           portable::log(plan.number_times[k + 1] / plan.number_times[k]));
          if (late) slope_time.push_back(portable::log(between.values[k]));
          if (late) late_slope.push_back(values.back());
        }
        values.push_back(fit_line(log_time, late_number).slope);
        values.push_back(fit_line(slope_time, late_slope).slope);
        std::vector<double> plateaus, fronts;
        for (std::size_t k = 0; k < times; ++k) {
          const std::span<const double> density = std::span(densities).subspan(k * speeds, speeds);
          plateaus.push_back(plateau(density, plan, plan.times[k], thermal));
          fronts.push_back(front(density, plan, plateaus.back()));
        }
        for (const auto* column : {&plateaus, &fronts})
          values.insert(values.end(), column->begin(), column->end());
        values.push_back(fit_power(plan.times, fronts, plan.times.front(), plan.times.back()));
        return values;
      });
}

}  // namespace

int main(int argc, char** argv) {
  Program program("particle_count", "Number and momenta of the particles in an open chain");
  OpenChainOptions options({.cells = 201, .cell_length = 1, .left = {100, 100}, .right = {100, 100}},
                           "empty");
  options.declare(program.options());
  std::vector<double> times{200, 600, 1000, 1400, 1800};
  program.options().ascending_list("--times", times, positive, "Times of the momentum distributions");
  MomentumBinsOptions bins(100, 50);
  bins.declare(program.options());
  ReplicaOptions replicas(program);
  replicas.declare(program.options());
  return program.run(argc, argv, [&](Progress& progress) {
    bins.validate();
    if (times.size() < 2 || times.back() < 2 * times.front())
      throw UsageError(
          "--times spans less than a factor of two: no slope in ln t can be had. Add later times.");
    options.validate(times.back(), "--times");
    const OpenChain chain = options.chain();
    const Plan plan(times, bins.bins(), chain.cell_length);
    const double thermal = std::sqrt(std::min(chain.left.temperature, chain.right.temperature));
    const auto measure = [&](const Replica& replica) {
      return options.measure(replica, {0, times.back()}, Census(plan));
    };
    const auto results = [&](const Records& records) { return summarise(records, plan, thermal); };
    return replicas.run({measure, results, "log_slope", RandomStream::description}, progress);
  });
}
