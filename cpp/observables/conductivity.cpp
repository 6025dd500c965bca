/// Heat conductivity kappa(N) of an open chain, from the energy current J_U (positive to the right) and the
/// temperatures <P^2>/M of the first and the last scatterer [eq. 27, 28]:
///
///   kappa = -J_U N / (T_N - T_1).
///
/// The paper prints kappa = J_U/(T_N - T_1) for a chain of length 1; its exponents need the gradient per
/// cell, hence the factor N. Both are stored. Currents are means over the two openings [eq. 26].
///
/// Control variates are the numbers, momenta and energies that the reservoirs inject [eq. 31], which at gamma
/// = N and with deterministic collisions are the only randomness, and for gamma < N the scattering
/// martingales of the end scatterers [eq. 32], whose means are exact for every collision rule. Quantities
/// named *_plain do without. kappa is NaN, and the reason is printed, where reservoirs do not impose a
/// difference of temperature. Stationarity is tested by the differences between the halves of the window [eq.
/// 51], and by blocking, for which blocks must be longer than the correlation time [eq. 50].
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <limits>

#include "model/rules.hpp"
#include "observables/conductivity/blocking.hpp"
#include "observables/conductivity/ends_and_openings.hpp"
#include "observables/conductivity/hotelling.hpp"
#include "observables/conductivity/window_means.hpp"
#include "sampling/open_run.hpp"
#include "statistics/control_variates.hpp"

namespace {

using namespace lorentz;

const WindowTallies of_window;
constexpr double level = 0.01;  // of the test of stationarity

Group::Prepared reduced(const Records& records) {
  return reduce_variance(records, {{of_window.measured(), of_window.controls()}});
}

/// Why a chain has no heat conductivity, with the remedy; empty if it has one.
std::string reason_without_kappa(const OpenChain& chain) {
  if (chain.left.rate == 0 || chain.right.rate == 0)
    return "heat is conducted between two reservoirs; choose --nu-left and --nu-right above 0";
  if (chain.left.temperature == chain.right.temperature)
    return "the reservoirs have one temperature; choose another --temperature-left or --temperature-right";
  if (chain.gamma == 0) return "no particle is scattered; choose a --gamma above 0";
  if (std::abs(chain.sigma) == 1)
    return "scatterers of mass 0 or infinity exchange no energy; choose a --sigma between -1 and 1";
  if (chain.sigma == 0 && rule_properties(chain.rule.name).conserves_momentum)
    return "equal masses only exchange momenta, so that no gradient of temperature forms; choose another "
           "--sigma";
  return chain.cells == 1 ? "a single cell has no difference of temperature; choose more --cells" : "";
}

void add_conductivity(Group& group, const OpenChain& chain, const std::string& suffix,
                      const std::string& remark) {
  const double cells = chain.cells;
  const bool defined = reason_without_kappa(chain).empty();
  const auto rise = [defined](double first, double last) {
    return !defined || first == last ? std::numeric_limits<double>::quiet_NaN() : last - first;
  };
  const auto per_degree = [rise](TallyMeans mean) {
    return -mean[of_window.energy_current] /
           rise(mean[of_window.temperature][0], mean[of_window.temperature][1]);
  };
  const auto particle_temperature = [](TallyMeans mean, std::size_t end) {
    return mean[of_window.arriving_energy][end] / mean[of_window.arrivals][end];
  };
  const std::string conductivity_units = "energy/(time temperature)";
  group.quantity("energy_current" + suffix, "energy/time", "J_U, positive to the right" + remark,
                 [](TallyMeans mean) { return mean[of_window.energy_current]; });
  group.quantity("particle_current" + suffix, "1/time", "J_n, positive to the right" + remark,
                 [](TallyMeans mean) { return mean[of_window.particle_current]; });
  group.quantity("temperature_first" + suffix, "temperature", "<P^2>/M of the first scatterer" + remark,
                 [](TallyMeans mean) { return mean[of_window.temperature][0]; });
  group.quantity("temperature_last" + suffix, "temperature", "<P^2>/M of the last scatterer" + remark,
                 [](TallyMeans mean) { return mean[of_window.temperature][1]; });
  group.quantity("kappa" + suffix, conductivity_units, "-J_U N / (T_N - T_1)" + remark,
                 [=](TallyMeans mean) { return per_degree(mean) * cells; });
  group.quantity("kappa_printed" + suffix, conductivity_units,
                 "-J_U / (T_N - T_1), the paper's definition" + remark, per_degree);
  group.quantity("kappa_particle" + suffix, conductivity_units,
                 "-J_U N / difference of <p^2>/m of the arrivals" + remark, [=](TallyMeans mean) {
                   return -mean[of_window.energy_current] /
                          rise(particle_temperature(mean, 0), particle_temperature(mean, 1)) * cells;
                 });
}

/// Correlation coefficient r over replicas of two tallies with the error of normal records, (1 - r^2)/sqrt(R
/// - 1); NaN if one does not vary.
Estimate correlation_coefficient(const Records& records, ScalarTally one, ScalarTally other) {
  const Eigen::MatrixXd x = centred(standardised(records, {one.column, other.column}));
  const double found = x.col(0).dot(x.col(1)) / (x.col(0).norm() * x.col(1).norm());
  const double r = std::abs(found) <= 1 ? found : std::numeric_limits<double>::quiet_NaN();
  return {{r}, {(1 - r * r) / std::sqrt(static_cast<double>(records.size()) - 1)}};
}

void add_drifts(Group& group) {
  group.quantity("energy_current_drift", "energy/time", "J_U, second half of the window minus first",
                 [](TallyMeans mean) { return mean[of_window.energy_current]; });
  group.quantity("particle_current_drift", "1/time", "J_n, second half minus first",
                 [](TallyMeans mean) { return mean[of_window.particle_current]; });
  group.quantity("temperature_first_drift", "temperature", "T_1, second half minus first",
                 [](TallyMeans mean) { return mean[of_window.temperature][0]; });
  group.quantity("temperature_last_drift", "temperature", "T_N, second half minus first",
                 [](TallyMeans mean) { return mean[of_window.temperature][1]; });
}

/// Error of J_U by blocking [eq. 50], p-value of the hypothesis that all four drifts are 0 [eq. 51], and
/// `stationary`: 1 if the p-value exceeds 0.01, so that the test rejects one stationary run in a hundred, and
/// the blocking has converged.
void add_stationarity(Group& group, const BlockTallies& tallies) {
  const Axis length{"length", "1", "Part of the window that a block takes", {0.125, 0.25, 0.5, 1}};
  const std::vector<Description> descriptions{
      {"blocking_error", "energy/time", "Error of the plain J_U from blocks", {length}},
      {"drift_p_value", "1", "p-value of the four drifts being 0, by Hotelling's T^2 test"},
      {"stationary", "1", "1: drift_p_value above 0.01, and blocking has converged"}};
  group.statistics(descriptions, [=](const Records& records) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const Group::Prepared differences = reduced(half_differences(records, tallies));
    const double p_value = zero_mean_p_value(differences.records, of_window.currents_and_temperatures(),
                                             *differences.control_variates ? of_window.controls().size() : 0);
    Records currents(block_count);
    for (std::size_t replica = 0; replica < records.size(); ++replica)
      currents.append(TallyMeans(records[replica])[tallies.energy_current]);
    const Blocking blocks = blocking(currents);
    Estimate estimate{blocks.error, blocks.uncertainty};
    for (const double value : {p_value, p_value > level && blocks.converged() ? 1.0 : 0.0}) {
      estimate.mean.push_back(value);
      estimate.standard_error.push_back(none);
    }
    return estimate;
  });
}

/// What restricts the meaning of the results.
std::vector<std::string> remarks(const OpenChain& chain, const Results& results) {
  std::vector<std::string> lines;
  if (const std::string reason = reason_without_kappa(chain); !reason.empty())
    lines.push_back("kappa is not defined: " + reason);
  if (quantity_named(results, "stationary").mean.front() == 1) return lines;
  const double p_value = quantity_named(results, "drift_p_value").mean.front();
  if (std::isnan(p_value))
    lines.emplace_back(
        "not tested whether stationary: too few replicas, or nothing varies; choose more --replicas");
  else if (p_value <= level)
    lines.push_back(fmt::format(
        "not stationary: the p-value of no drift is {:.1g}; choose a longer --relaxation-time", p_value));
  else
    lines.emplace_back(
        "not stationary: correlations last longer than half the window; choose a longer "
        "--observation-time");
  return lines;
}

Study conductivity(const StationaryParameters& parameters) {
  validate(parameters);
  const OpenChain chain = parameters.chain();
  const Window window = parameters.window();
  const BlockTallies tallies;
  Group corrected([=](const Records& records) { return reduced(window_means(records, tallies)); });
  Group plain([=](const Records& records) { return Group::Prepared{window_means(records, tallies)}; });
  Group halves([=](const Records& records) { return reduced(half_differences(records, tallies)); });
  Group stationary;
  add_conductivity(corrected, chain, "", "");
  corrected.statistics({{"current_correlation", "1", "Correlation coefficient over replicas of J_U and J_n"}},
                       [](const Records& records) {
                         return correlation_coefficient(records, of_window.energy_current,
                                                        of_window.particle_current);
                       });
  add_conductivity(plain, chain, "_plain", ", without control variates");
  add_drifts(halves);
  add_stationarity(stationary, tallies);
  Study study = open_study(
      parameters, window, tallies, [=] { return EndsAndOpenings(chain, window); },
      {corrected, plain, halves, stationary},
      reason_without_kappa(chain).empty() ? "kappa" : "energy_current");
  study.remarks = [chain](const Results& results) { return remarks(chain, results); };
  return study;
}

}  // namespace

int main(int argc, char** argv) {
  StudyProgram program("conductivity", "Heat conductivity of an open chain");
  StationaryParameters parameters;
  parameters.relaxation_time = 50;
  parameters.observation_time = 400;
  declare(program.options(), parameters);
  return program.run(argc, argv, [&] { return conductivity(parameters); });
}
