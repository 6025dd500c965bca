#include "sampling/stationarity.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <limits>

#include "statistics/control_variates.hpp"
#include "statistics/standardised.hpp"

namespace lorentz {
namespace {

constexpr double level = 1e-4, tolerated_gain = 4e-3;
constexpr std::size_t least = 8;  // replicas; with fewer even ten standard errors could be chance

/// Smallest p-value of the hypotheses that the mean of a column is 0, times their number [eq. 47]. Records
/// are those left after `fitted` coefficients have been estimated from them. Columns that do not vary are
/// left out; NaN if none is left, or with too few records.
double smallest_p_value(const Records& records, const Columns& columns, std::size_t fitted) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (records.size() < least + fitted) return none;
  const auto rows = static_cast<double>(records.size());
  const Matrix x = standardised(records, columns);
  double smallest = 2, number = 0;
  for (std::size_t k = 0; k < x.columns(); ++k) {
    if (!varies(x, k)) continue;
    double sum = 0;
    for (std::size_t i = 0; i < x.rows(); ++i) sum += x(i, k);
    const double t = std::abs(sum) * std::sqrt((rows - 1) / rows);  // the deviations have norm 1
    smallest = std::min(smallest, 2 * gsl_cdf_tdist_Q(t, rows - 1 - static_cast<double>(fitted)));
    number += 1;
  }
  return number > 0 ? std::min(1., number * smallest) : none;
}

}  // namespace

Group stationarity(const HalfDifferenceTallies& tallies, const OpenChain& chain) {
  Group group;
  const std::vector<Description> descriptions{
      {"stationarity_p_value", "1", "p-value of no change of currents, temperatures and energy"},
      {"particle_gain", "1", "Particles that enter minus those that leave, over those that enter"},
      {"stationary", "1",
       "1: stationarity_p_value above 1e-4, |particle_gain| within 4e-3; nan: not tested"}};
  group.statistics(descriptions, [=](const Records& records) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const Columns controls = columns_of({tallies.injection});
    const Group::Prepared halves = reduce_variance(records, {{tallies.halves(), controls}});
    const double of_halves =
                     smallest_p_value(halves.records, tallies.halves(), halves.control_variates->used),
                 of_energy = smallest_p_value(records, columns_of({tallies.energy}), 0);
    // Half of the level for each, NaN left out.
    const double p_value = std::min(2 * std::fmin(of_halves, of_energy), 1.);
    const Estimates gain = jackknife(records, [=](TallyMeans mean) {
      return std::vector{mean[tallies.particles] / (chain.left.rate + chain.right.rate)};
    });
    const double share = gain.mean.front(), error = gain.standard_error.front();
    const bool tested = !std::isnan(p_value) && error <= tolerated_gain,
               stationary = p_value > level && std::abs(share) - 3 * error <= tolerated_gain;
    return Estimates{{p_value, share, tested ? static_cast<double>(stationary) : none}, {none, error, none}};
  });
  return group;
}

std::vector<std::string> remarks_on_stationarity(const Results& results) {
  const double stationary = quantity_named(results, "stationary").mean.front();
  const Quantity& gain = quantity_named(results, "particle_gain");
  if (std::isnan(stationary))
    return {
        "not tested whether stationary: too few replicas or injections; choose more --replicas, or a longer "
        "--observation-time"};
  if (stationary == 1) {  // 0, 1 or NaN
    const double share = gain.mean.front();
    if (std::abs(share) < 3 * gain.standard_error.front()) return {};
    return {fmt::format(
        "stationary within the sensitivity of the test: slow particles still accumulate, {:+.2g} of those "
        "injected, so that J_n may be off by half of this part of --nu-left plus --nu-right; choose a longer "
        "--relaxation-time",
        share)};
  }
  return {fmt::format(
      "not stationary: the p-value of no change is {:.1g}, and the number of particles changes by "
      "{:+.2g} of those injected; choose a longer --relaxation-time",
      quantity_named(results, "stationarity_p_value").mean.front(), gain.mean.front())};
}

}  // namespace lorentz
