/// Heat conductivity kappa(N) of an open chain, from the energy current J_U (positive to the right) and the
/// temperatures <P^2>/M of the first and the last scatterer [eq. 26, eq. 27]:
///
///   kappa = -J_U N / (T_N - T_1).
///
/// The paper prints kappa = J_U/(T_N - T_1) for a chain of length 1; its exponents need the gradient per
/// cell, hence the factor N. Currents are means over the two openings [eq. 25]. kappa_heat is that of the
/// heat J_U - T J_n alone, without the energy T that a particle carries on average [eq. 54].
///
/// Control variates are the numbers, momenta and energies that the reservoirs inject [eq. 30], which at gamma
/// = N and with deterministic collisions are the only randomness, and for gamma < N the scattering
/// martingales of the end scatterers [eq. 31], whose means are exact for every collision rule. kappa is
/// NaN, and the reason is printed, where reservoirs do not impose a difference of temperature, or where it is
/// less than five of its standard errors.
#include <cmath>
#include <limits>

#include "model/conduction.hpp"
#include "model/rules.hpp"
#include "observables/conductivity/end_scatterers.hpp"
#include "sampling/stationarity.hpp"
#include "statistics/control_variates.hpp"

namespace {

using namespace lorentz;

const EndTallies tallies;

/// Why a chain has no heat conductivity, with the remedy; empty if it has one.
std::string reason_without_kappa(const OpenChain& chain) {
  const RuleProperties& rule = rule_properties(chain.rule.name);
  const bool conducts = !rule.conducts || rule.conducts(chain.sigma, chain.rule.options);
  std::string reason = reason_without_conduction(chain.left, chain.right, chain.gamma, chain.sigma, conducts);
  if (!reason.empty()) return reason;
  return chain.cells == 1 ? "a single cell has no difference of temperature; choose more --cells" : "";
}

double rise(TallyMeans mean) { return mean[tallies.temperature][1] - mean[tallies.temperature][0]; }

/// J_U - T J_n at the mean temperature of both ends.
double heat_current(TallyMeans mean) {
  const double temperature = 0.5 * (mean[tallies.temperature][0] + mean[tallies.temperature][1]);
  return mean[tallies.energy_current] - temperature * mean[tallies.particle_current];
}

/// -J_U and -(J_U - T J_n) times the number of cells over the rise of temperature; NaN unless the rise is at
/// least five of its standard errors, because a ratio to a number that may be 0 has neither a mean nor an
/// error. The error is 0 with one replica.
Group::Array conductivities(const Records& records, double cells, bool defined) {
  const Estimates difference = jackknife(records, [](TallyMeans mean) { return std::vector{rise(mean)}; });
  const double error = records.size() > 1 ? difference.standard_error.front() : 0;
  const bool resolved = defined && std::abs(difference.mean.front()) > 5 * error;
  return [=](TallyMeans mean) {
    const double per_rise = resolved ? -cells / rise(mean) : std::numeric_limits<double>::quiet_NaN();
    return std::vector{per_rise * mean[tallies.energy_current], per_rise * heat_current(mean)};
  };
}

/// Currents, temperatures of the end scatterers and the conductivity.
Group currents_and_conductivity(const OpenChain& chain) {
  Group group([](const Records& records) {
    return reduce_variance(records, {{tallies.measured(), tallies.controls()}});
  });
  group.quantity(tallies, tallies.energy_current);
  group.quantity(tallies, tallies.particle_current);
  const auto temperature = [&](const char* name, const char* description, std::size_t i) {
    group.quantity(name, "temperature", description,
                   [=](TallyMeans mean) { return mean[tallies.temperature][i]; });
  };
  temperature("temperature_first", "<P^2>/M of the first scatterer", 0);
  temperature("temperature_last", "<P^2>/M of the last scatterer", 1);
  const char* const units = "energy/(time temperature)";
  group.quantities({{"kappa", units, "-J_U N / (T_N - T_1)"},
                    {"kappa_heat", units, "-(J_U - T J_n) N / (T_N - T_1), T = (T_1 + T_N)/2"}},
                   [cells = chain.cells, defined = reason_without_kappa(chain).empty()](
                       const Records& records) { return conductivities(records, cells, defined); });
  return group;
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
  for (const std::string& line : remarks_on_stationarity(results)) lines.push_back(line);
  return lines;
}

Study conductivity(const StationaryParameters& parameters) {
  validate(parameters);
  const OpenChain chain = parameters.chain();
  const Window window = parameters.window();
  Study study = stationary_study(
      parameters, tallies, [=] { return EndScatterers(chain, window); }, {currents_and_conductivity(chain)},
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
