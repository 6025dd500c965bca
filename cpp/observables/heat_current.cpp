// For the study "does the paper hold?" only (panel `momentum`); no figure of the paper needs it.
/// Integrated heat current of a closed chain in the stationary state: Q, the integral over a time t of J_q =
/// sum of u (u^2/2 - T), as a mean square per cell over all origins of time in a record and over replicas.
///
/// Where collisions conserve momentum, mode coupling predicts [eq. 55]
///
///   <Q^2>/N = (T lambda)^2 [ 4.5 A s^(4/3) + 2 D s ],  s = t sqrt(T)/lambda,
///
/// with A = 0 where momentum is not conserved. The totals of a ring fluctuate: at fixed totals <Q^2> would be
/// smaller by a part of order t^2/N. Sound must not travel around the ring within the longest time: the panel
/// refuses such a ring [eqs. 52, 53].
#include "observables/heat_current/heat_current.hpp"

#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>
#include <span>

#include "observables/heat_current/parameters.hpp"
#include "sampling/closed_run.hpp"
#include "statistics/fit.hpp"
#include "statistics/log_grid.hpp"

namespace {

using namespace lorentz;

using Parameters = HeatCurrentParameters;

struct Tallies : ClosedTallies {
  Axis time;
  Tally heat = tally("mean_square_heat", {time}, "energy^2 length^2",
                     "<Q^2>/N: mean square of the heat that passes in a time, per cell");

  explicit Tallies(const std::vector<double>& times)
      : time{"time", "time", "Time over which the current is integrated", times} {}
};

/// Mean over all origins of the square of a sum over `lag` successive values.
double mean_square(std::span<const double> sums, std::size_t lag) {
  double squares = 0;
  for (std::size_t j = 0; j + lag < sums.size(); ++j) {
    const double difference = sums[j + lag] - sums[j];
    squares += difference * difference;
  }
  return squares / static_cast<double>(sums.size() - lag);
}

/// 0, x_0, x_0 + x_1, ...
std::vector<double> sums_of(const std::vector<double>& x) {
  std::vector<double> sums{0};
  std::partial_sum(x.begin(), x.end(), std::back_inserter(sums));
  return sums;
}

void observe(const Parameters& parameters, const Tallies& tallies, const std::vector<std::size_t>& windows,
             ClosedRun& run, TallySums& sums) {
  const double interval = parameters.times.front(), cells = parameters.chain().cells;
  const std::size_t intervals = parameters.intervals(windows);
  const Blocks blocks(0, static_cast<double>(intervals) * interval, intervals);
  HeatCurrent current(run, parameters.ring, parameters.temperature, blocks);
  run.observe(current);
  current.finish();
  const std::vector<double> heat = sums_of(current.integrals());
  for (std::size_t k = 0; k < windows.size(); ++k)
    sums[tallies.heat][k] = mean_square(heat, windows[k]) / cells;
}

Group growth_of_heat(const Tallies& tallies) {
  const std::vector<double> times = tallies.time.values;
  const Axis middle{"middle", "time", "Geometric middle of two neighbouring times", geometric_middles(times)};
  Group group;
  group.quantity(tallies, tallies.heat);
  group.quantity("local_exponent", {middle}, "1", "d ln <Q^2> / d ln t between two times",
                 [=](TallyMeans mean) { return local_exponents(times, mean[tallies.heat]); });
  return group;
}

Study heat_current(const Parameters& parameters) {
  validate(parameters);
  const Tallies tallies(parameters.times);
  return closed_study(parameters, tallies,
                      std::bind_front(observe, parameters, tallies, lags(parameters.times)),
                      {growth_of_heat(tallies)}, "mean_square_heat");
}

}  // namespace

int main(int argc, char** argv) {
  StudyProgram program("heat_current", "Heat that passes in a time in a closed chain in equilibrium");
  Parameters parameters;
  declare(program.options(), parameters);
  return program.run(argc, argv, [&] { return heat_current(parameters); });
}
