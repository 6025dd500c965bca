/// Heat conductivity kappa(N) of an open chain, from the energy current J_U (positive to the right) and the
/// temperatures <P^2>/M of the first and the last scatterer [eq. 27, eq. 28]:
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
/// difference of temperature, or where it is less than five of its standard errors. Stationarity is tested by
/// the differences between the halves of the window [eq. 51], and by blocking, for which blocks must be
/// longer than the correlation time [eq. 50].
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <limits>

#include "model/rules.hpp"
#include "observables/conductivity/blocking.hpp"
#include "observables/conductivity/ends_and_openings.hpp"
#include "observables/conductivity/hotelling.hpp"
#include "sampling/open_run.hpp"
#include "statistics/control_variates.hpp"
#include "statistics/standardised.hpp"

namespace {

using namespace lorentz;

const BlockTallies of_blocks, of_window(1);
constexpr double level = 0.01;  // of the test of stationarity

/// The tallies by blocks as tallies with one block: means over the window or, for the test of stationarity,
/// over its second half minus those over the first [eq. 51]. Arrivals are those of the whole window.
Records joined(const Records& records, bool difference) {
  Records result(of_window.width());
  for (std::size_t replica = 0; replica < records.size(); ++replica) {
    const TallyMeans row = records[replica];
    TallySums window(of_window);
    const auto join = [&](Tally from, Tally to, double scale) {
      for (std::size_t i = 0; i < to.size; ++i) {
        double sum = 0;
        for (std::size_t block = 0; block < block_count; ++block)
          sum += (difference && block < block_count / 2 ? -1 : 1) * row[from.row(block)][i];
        window[to][i] = scale * sum;
      }
    };
    const double per_block = (difference ? 2. : 1.) / block_count;
    join(of_blocks.energy_current, of_window.energy_current, per_block);
    join(of_blocks.particle_current, of_window.particle_current, per_block);
    join(of_blocks.temperature, of_window.temperature, per_block);
    join(of_blocks.injection, of_window.injection, 1);
    join(of_blocks.scattering, of_window.scattering, 1);
    window.set(of_window.arriving_energy, row[of_blocks.arriving_energy]);
    window.set(of_window.arrivals, row[of_blocks.arrivals]);
    result.append(window.values());
  }
  return result;
}

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
  const bool elastic = rule_properties(chain.rule.name).conserves_momentum ||
                       chain.rule.options == std::vector{0.};  // a reversal that never happens
  if (chain.sigma == 0 && elastic)
    return "equal masses only exchange momenta, so that no gradient of temperature forms; choose another "
           "--sigma";
  return chain.cells == 1 ? "a single cell has no difference of temperature; choose more --cells" : "";
}

double rise(TallyMeans mean) { return mean[of_window.temperature][1] - mean[of_window.temperature][0]; }

double rise_of_particles(TallyMeans mean) {
  const auto energy = mean[of_window.arriving_energy], arrivals = mean[of_window.arrivals];
  return energy[1] / arrivals[1] - energy[0] / arrivals[0];
}

/// -J_U `factor` over a rise of temperature; NaN unless the rise is at least five of its standard errors,
/// because a ratio to a number that may be 0 has neither a mean nor an error. The error is 0 with one
/// replica.
Group::Array current_per_rise(const Records& records, double (*of)(TallyMeans), double factor, bool defined) {
  const Estimate found = jackknife(records, [of](TallyMeans mean) { return std::vector{of(mean)}; });
  const double error = records.size() > 1 ? found.standard_error.front() : 0;
  const bool resolved = defined && std::abs(found.mean.front()) > 5 * error;
  return [=](TallyMeans mean) {
    return std::vector{resolved ? -mean[of_window.energy_current][0] / of(mean) * factor
                                : std::numeric_limits<double>::quiet_NaN()};
  };
}

/// Currents, temperatures of the end scatterers and conductivities.
void add_conductivity(Group& group, const OpenChain& chain, const std::string& suffix,
                      const std::string& remark) {
  const bool defined = reason_without_kappa(chain).empty();
  const auto element = [&](const std::string& name, const char* units, const std::string& description,
                           Tally tally, std::size_t i) {
    group.quantity(name + suffix, units, description + remark,
                   [=](TallyMeans mean) { return mean[tally][i]; });
  };
  const auto ratio = [&](const std::string& name, const std::string& description, auto to, double factor) {
    group.quantities({{name + suffix, "energy/(time temperature)", description + remark}},
                     [=](const Records& records) { return current_per_rise(records, to, factor, defined); });
  };
  element("energy_current", "energy/time", "J_U, positive to the right", of_window.energy_current, 0);
  element("particle_current", "1/time", "J_n, positive to the right", of_window.particle_current, 0);
  element("temperature_first", "temperature", "<P^2>/M of the first scatterer", of_window.temperature, 0);
  element("temperature_last", "temperature", "<P^2>/M of the last scatterer", of_window.temperature, 1);
  ratio("kappa", "-J_U N / (T_N - T_1)", rise, chain.cells);
  ratio("kappa_printed", "-J_U / (T_N - T_1), the paper's definition", rise, 1);
  ratio("kappa_particle", "-J_U N / difference of <p^2>/m of the arrivals", rise_of_particles, chain.cells);
}

/// Correlation coefficient r over replicas of two tallies with the error of normal records, (1 - r^2)/sqrt(R
/// - 1); NaN if one does not vary.
Estimate correlation_coefficient(const Records& records, Tally one, Tally other) {
  const Eigen::MatrixXd x = centred(standardised(records, {one.first, other.first}));
  const double found = x.col(0).dot(x.col(1)) / (x.col(0).norm() * x.col(1).norm());
  const double r = std::abs(found) <= 1 ? found : std::numeric_limits<double>::quiet_NaN();
  return {{r}, {(1 - r * r) / std::sqrt(static_cast<double>(records.size()) - 1)}};
}

/// Error of J_U by blocking [eq. 50], p-value of the hypothesis that all four drifts are 0 [eq. 51], and
/// `stationary`: 1 if the p-value exceeds 0.01, so that the test rejects one stationary run in a hundred, and
/// the blocking has converged.
void add_stationarity(Group& group) {
  const Axis length{"length", "1", "Part of the window that a block takes", {0.125, 0.25, 0.5, 1}};
  const std::vector<Description> descriptions{
      {"blocking_error", "energy/time", "Error of the plain J_U from blocks", {length}},
      {"drift_p_value", "1", "p-value of the four drifts being 0, by Hotelling's T^2 test"},
      {"stationary", "1", "1: drift_p_value above 0.01, and blocking has converged"}};
  group.statistics(descriptions, [](const Records& records) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const Group::Prepared differences = reduced(joined(records, true));
    const double p_value = zero_mean_p_value(differences.records, of_window.currents_and_temperatures(),
                                             *differences.control_variates ? of_window.controls().size() : 0);
    Records currents(block_count);
    for (std::size_t replica = 0; replica < records.size(); ++replica)
      currents.append(TallyMeans(records[replica])[of_blocks.energy_current]);
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
  else if (std::isnan(quantity_named(results, "kappa").mean.front()))
    lines.emplace_back(
        "kappa is not defined: T_N - T_1 is less than five of its standard errors; choose more --replicas or "
        "a longer --observation-time");
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
  Group corrected([](const Records& records) { return reduced(joined(records, false)); });
  Group plain([](const Records& records) { return Group::Prepared{joined(records, false)}; });
  Group stationary;
  add_conductivity(corrected, chain, "", "");
  corrected.statistics({{"current_correlation", "1", "Correlation coefficient over replicas of J_U and J_n"}},
                       [](const Records& records) {
                         return correlation_coefficient(records, of_window.energy_current,
                                                        of_window.particle_current);
                       });
  add_conductivity(plain, chain, "_plain", ", without control variates");
  add_stationarity(stationary);
  Study study = open_study(
      parameters, window, of_blocks, [=] { return EndsAndOpenings(chain, window); },
      {corrected, plain, stationary}, reason_without_kappa(chain).empty() ? "kappa" : "energy_current");
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
