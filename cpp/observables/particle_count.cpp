/// Particles inside an open chain that is empty at the start: their number n(t), and their momentum density
/// n_t(p) times |p| at given times.
///
/// The stationary density F(p)/|p| is not normalisable: n_t(p) |p| is stationary only above a front p_0(t)
/// [eq. 23], and n(t) grows by L (F(0+) + F(0-)) per unit of ln t, with L the length of the chain [eq. 24].
/// p_0 is the momentum of a sharp front below which the plateau of |p| n_t(p) would lack as many particles as
/// it does, so that it is a smooth function of means.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "observables/particle_count/census.hpp"
#include "sampling/open_run.hpp"
#include "statistics/fit.hpp"

namespace {

using namespace lorentz;

/// Mean of y over the points with low <= x <= high; NaN if there are none.
double mean_between(const std::vector<double>& x, std::span<const double> y, double low, double high) {
  double sum = 0, points = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (x[i] < low || x[i] > high) continue;
    sum += y[i];
    points += 1;
  }
  return sum / points;
}

struct Parameters : OpenParameters {
  std::vector<double> times{200, 600, 1000, 1400, 1800};
  MomentumBinParameters bins{.max = 50};

  Parameters() {
    scattering.cells = 201;
    cell_length = 1;
    left = right = {100, 100};
    start = "empty";
  }
};

/// Quantities of a mean record; `thermal` is the thermal momentum of the colder bath.
struct Reading {
  TallyMeans mean;
  const CensusTallies& tallies;
  const CensusGrid& grid;
  double thermal;

  /// |p| n_t(p), summed over both signs of p, on logarithmic bins at all times [eq. 23].
  std::vector<double> speed_density() const {
    const std::vector<double> edges = grid.speeds.points();
    return mean_of(tallies.by_speed, std::log(edges[1] / edges[0]))(mean);
  }

  /// Slopes d n / d ln t between neighbouring times [eq. 24].
  std::vector<double> number_slopes() const {
    const auto number = mean[tallies.number];
    std::vector<double> slopes;
    for (std::size_t k = 0; k + 1 < number.size(); ++k)
      slopes.push_back((number[k + 1] - number[k]) /
                       std::log(grid.number_times[k + 1] / grid.number_times[k]));
    return slopes;
  }

  /// Slope against ln t of y, given at the times `at`, over the times of n from the first
  /// snapshot on.
  double late_slope(std::span<const double> y, const std::vector<double>& at) const {
    const double first = grid.times.front() * (1 - 1e-9);  // slightly below a grid point
    const auto early = static_cast<std::size_t>(std::ranges::count_if(
        std::span(grid.number_times).first(y.size()), [first](double time) { return time < first; }));
    return fit_logarithm(std::span(at).subspan(early), y.subspan(early), 0, grid.times.back());
  }

  /// Means of the density above the front, from 10 free paths per t to a fifth of the thermal momentum.
  std::vector<double> plateaus() const {
    const std::vector<double> densities = speed_density();
    const std::size_t speeds = tallies.speed.values.size();
    std::vector<double> values;
    for (std::size_t k = 0; k < grid.times.size(); ++k)
      values.push_back(mean_between(tallies.speed.values, std::span(densities).subspan(k * speeds, speeds),
                                    10 * grid.free_path / grid.times[k], 0.2 * thermal));
    return values;
  }

  /// p_0 [eq. 24] from the particles slower than about 4 free paths per t, where the plateau begins: fewer
  /// particles than below its bins have less noise. NaN without a plateau.
  std::vector<double> fronts() const {
    const std::vector<double> edges = grid.speeds.points(), plateau = plateaus();
    std::vector<double> values;
    for (std::size_t k = 0; k < grid.times.size(); ++k) {
      const std::size_t edge = grid.speeds.interval(4 * grid.free_path / grid.times[k]);
      const auto bins = mean[tallies.by_speed.row(k)].first(edge);
      const double slower = std::accumulate(bins.begin(), bins.end(), mean[tallies.slower][k]);
      values.push_back(plateau[k] > 0 ? edges[edge] * std::exp(-slower / plateau[k])
                                      : std::numeric_limits<double>::quiet_NaN());
    }
    return values;
  }
};

Group numbers_and_momenta(const CensusTallies& tallies, const CensusGrid& grid, double thermal) {
  const std::vector<double> between = geometric_middles(grid.number_times);
  const auto reading = [=](TallyMeans mean) { return Reading{mean, tallies, grid, thermal}; };
  Group group;
  group.quantity("weighted_momentum_density", {tallies.time, tallies.p}, "1",
                 "|p| n_t(p), n_t being particles per unit momentum",
                 mean_of(tallies.momentum, grid.bins.width()));
  group.quantity("weighted_speed_density", {tallies.time, tallies.speed}, "1",
                 "|p| n_t(p), both signs, on logarithmic bins",
                 [=](TallyMeans mean) { return reading(mean).speed_density(); });
  group.quantity(tallies, tallies.number);
  group.quantity(
      "log_slope", "1", "Slope of n against ln t from the first of --times on",
      [=](TallyMeans mean) { return reading(mean).late_slope(mean[tallies.number], grid.number_times); });
  group.quantity(
      "log_curvature", "1", "Slope of dn/d ln t against ln t over the same times; 0 if n ~ ln t",
      [=](TallyMeans mean) { return reading(mean).late_slope(reading(mean).number_slopes(), between); });
  group.quantity("plateau", {tallies.time}, "1",
                 "|p| n_t(p) above the front, both signs: what dn/d ln t should be",
                 [=](TallyMeans mean) { return reading(mean).plateaus(); });
  group.quantity("front", {tallies.time}, "momentum",
                 "p_0(t): sharp lower end of a plateau with as many particles",
                 [=](TallyMeans mean) { return reading(mean).fronts(); });
  group.quantity("front_exponent", "1", "Slope of ln p_0 against ln t", [=](TallyMeans mean) {
    return fit_power(grid.times, reading(mean).fronts(), grid.times.front(), grid.times.back());
  });
  return group;
}

Study particle_count(const Parameters& parameters) {
  validate(parameters.bins);
  if (parameters.times.size() < 2 || parameters.times.back() < 2 * parameters.times.front())
    throw UsageError(
        "--times spans less than a factor of two: a slope in ln t would be undetermined. Add later times.");
  validate(parameters, parameters.times.back(), "--times");
  const OpenChain chain = parameters.chain();
  const CensusGrid grid(parameters.times, parameters.bins.bins(), chain.free_path());
  const CensusTallies tallies(grid);
  const double thermal = std::sqrt(std::min(chain.left.temperature, chain.right.temperature));
  return open_study(
      parameters, {0, grid.times.back()}, tallies, [=] { return Census(grid); },
      {numbers_and_momenta(tallies, grid, thermal)}, "log_slope");
}

}  // namespace

int main(int argc, char** argv) {
  StudyProgram program("particle_count", "Number and momenta of the particles in an open chain");
  Parameters parameters;
  declare(program.options(), parameters, Role::physics);
  program.options().ascending_list(Role::output, "--times", parameters.times, positive, "time",
                                   "Times of the momentum distributions");
  declare(program.options(), parameters.bins);
  return program.run(argc, argv, [&] { return particle_count(parameters); });
}
