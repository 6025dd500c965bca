/// Solution of the kinetic (Boltzmann) equation of the open chain, the limit of infinitely many cells and
/// particles at fixed gamma, in which a particle and the scatterer that it reaches are independent [eq. 36],
///
///   sign(p) dF/dx = gamma [ int dU F(u') g(U') - F ],   g(U) int F du = int du F(u') g(U'),   0 < x < 1,
///
/// with F(p > 0) at x = 0 and F(p < 0) at x = 1 given by the reservoirs (half-Gaussian) [eq. 5]. With --cells
/// it is solved for a chain of N scatterers, each with its own F and g (mean field) [eq. 41].
///
/// The result is deterministic. The error of a quantity is twice the sum of the changes with the order of the
/// series that are still to come, if they fall as those of F did, and rounding. F and its changes are
/// compared at momenta and positions that do not depend on the output.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "boltzmann/kinetic_equation.hpp"
#include "model/conduction.hpp"
#include "program/program.hpp"
#include "sampling/momentum_bins.hpp"
#include "sampling/reservoir_parameters.hpp"

namespace {

using namespace lorentz;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Defaults: figure 3 of the paper.
struct Parameters {
  double sigma = 0.5;
  std::optional<double> gamma = 1;       // none: N, one scattering at each of the cells
  std::optional<std::uint32_t> cells{};  // none: continuum
  Reservoir left = default_left, right = default_right;
  std::vector<double> positions{0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1};
  MomentumBinParameters bins;
  double target_error = 1e-6;

  KineticProblem problem() const {
    return {sigma, gamma.value_or(cells.value_or(0)), left, right, cells.value_or(0)};
  }
};

void declare(Options& options, Parameters& parameters) {
  options.real(Role::physics, "--sigma", parameters.sigma, {-0.99, 0.99}, "1", "Mass ratio (M-m)/(M+m)");
  options.real_or_word(Role::physics, "--gamma", parameters.gamma, {0, 500}, "N", "1",
                       "Mean number of scatterings on the way through; N: one at each of --cells");
  options.integer_or_word(Role::physics, "--cells", parameters.cells, {1, 500}, "continuum",
                          "Number of scatterers of a mean-field chain");
  declare(options, parameters.left, parameters.right);
  options.ascending_list(Role::output, "--positions", parameters.positions, {0, 1}, "1",
                         "Positions of the continuum's output, over the length of the chain");
  declare(options, parameters.bins);
  options.real(Role::effort, "--target-error", parameters.target_error, non_negative, "1",
               "Error of F relative to its maximum, and of the currents, at which the order suffices");
}

/// Throws UsageError if options that are valid one by one exclude each other.
void validate(const Parameters& parameters, bool positions_given) {
  validate(parameters.bins);
  if (!parameters.cells && !parameters.gamma)
    throw UsageError(
        "--gamma N is given without --cells: the continuum has no number of cells. Give --cells, or gamma as "
        "a number.");
  if (parameters.cells) require_probability(parameters.gamma, *parameters.cells);
  if (parameters.cells && positions_given)
    throw UsageError(
        "--positions and --cells are both given: the positions of a chain are its bonds. Leave out one of "
        "the two.");
  if (parameters.left.rate + parameters.right.rate == 0)
    throw UsageError(
        "--nu-left and --nu-right are both 0: there are no particles. Choose one greater than 0.");
}

/// Flux at positions of the continuum, or of a chain.
struct Profile {
  std::vector<Flux> crossings, scatterers;

  Profile(const Parameters& parameters, const std::vector<double>& positions,
          const KineticSolution& solution) {
    if (!parameters.cells) {
      for (const double x : positions) crossings.push_back(solution.at(x));
      scatterers = crossings;
      return;
    }
    for (std::size_t bond = 0; bond <= *parameters.cells; ++bond) crossings.push_back(solution.at_bond(bond));
    for (std::size_t site = 0; site < *parameters.cells; ++site)
      scatterers.push_back(solution.at_scatterer(site));
  }
};

/// Quantity with its formula, the scale of its rounding error (its largest value, but for currents, which may
/// vanish, what both baths inject), and what states its error: a quantity at bins of the output has that of
/// F.
struct Definition {
  using Formula = std::function<std::vector<double>(const Profile&)>;
  Description what;
  Formula formula;
  double scale = 0;
  bool has_error_of_flux = false;
};

/// Formula of a quantity along an axis of positions.
Definition::Formula at_every(std::vector<Flux> Profile::* positions,
                             const std::function<std::vector<double>(const Flux&)>& formula) {
  return [=](const Profile& profile) {
    std::vector<double> all;
    for (const Flux& flux : profile.*positions) {
      const std::vector<double> values = formula(flux);
      all.insert(all.end(), values.begin(), values.end());
    }
    return all;
  };
}

/// F at p = 0+ and 0-, and up to six thermal momenta of either bath, in steps that resolve the highest order.
Definition::Formula flux_for_errors(const Parameters& parameters) {
  std::vector<double> momenta;
  for (const double temperature : {parameters.left.temperature, parameters.right.temperature})
    for (int k = 0; k <= 96; ++k) momenta.push_back(k / 16. * std::sqrt(temperature));
  return at_every(&Profile::crossings, [=](const Flux& flux) {
    std::vector<double> values;
    for (const double p : momenta) values.insert(values.end(), {flux.left.density(p), flux.right.density(p)});
    return values;
  });
}

/// Why there is no conductivity; empty if there is one.
std::string reason_without_kappa(const Parameters& parameters) {
  if (!parameters.cells) return "the continuum has no scatterers at its ends; choose --cells";
  if (*parameters.cells == 1) return "a single cell has no difference of temperature; choose more --cells";
  return reason_without_conduction(parameters.left, parameters.right, parameters.problem().gamma,
                                   parameters.sigma, parameters.sigma != 0);
}

/// -J_U N/(T_N - T_1) [eq. 28].
double conductivity(const Parameters& parameters, const Profile& profile) {
  if (!reason_without_kappa(parameters).empty()) return none;
  return -profile.crossings.front().energy_current() * *parameters.cells /
         (profile.scatterers.back().scatterer_temperature(parameters.sigma) -
          profile.scatterers.front().scatterer_temperature(parameters.sigma));
}

std::vector<Definition> definitions(const Parameters& parameters) {
  const Bins bins = parameters.bins.bins();
  const double sigma = parameters.sigma, particles = parameters.left.rate + parameters.right.rate,
               energy = parameters.left.rate * parameters.left.mean_energy() +
                        parameters.right.rate * parameters.right.mean_energy();
  Axis x{"x", "1", "Position over the length of the chain; bonds of a chain of cells", parameters.positions};
  Axis site{"x", "1", "Position over the length of the chain; scatterers of a chain of cells",
            parameters.positions};
  if (parameters.cells) {
    x.values.clear(), site.values.clear();
    for (std::uint32_t k = 0; k <= *parameters.cells; ++k)
      x.values.push_back(k / static_cast<double>(*parameters.cells));
    for (std::uint32_t k = 0; k < *parameters.cells; ++k)
      site.values.push_back((k + 0.5) / *parameters.cells);
  }
  const Axis momentum = momentum_axis(bins);
  const Axis half{"half", "1", "Sign of p", {-1, 1}};
  const auto crossings = &Profile::crossings, scatterers = &Profile::scatterers;
  const auto mean_over_bins = [=](const Flux& flux) {
    std::vector<double> values;
    for (std::size_t bin = 0; bin < bins.count(); ++bin)
      values.push_back(flux.integral(bins.edge(bin), bins.edge(bin + 1)) / bins.width());
    return values;
  };
  const auto density = [=](const Flux& flux) {
    std::vector<double> values;
    for (const double p : momentum.values) values.push_back(flux.density(p));
    return values;
  };
  return {{{"flux", "1/(time momentum)", "F(p, x), mean over a bin of p", {x, momentum}},
           at_every(crossings, mean_over_bins),
           0,
           true},
          {{"flux_density", "1/(time momentum)", "F(p, x)", {x, momentum}},
           at_every(crossings, density),
           0,
           true},
          {{"jump", "1/(time momentum)", "F at p = 0+ minus p = 0-", {x}},
           at_every(crossings, [](const Flux& flux) { return std::vector{flux.jump()}; })},
          {{"particle_current", "1/time", "Particles to the right minus to the left"},
           [](const Profile& profile) { return std::vector{profile.crossings.front().particle_current()}; },
           particles},
          {{"energy_current", "energy/time", "Energy to the right minus to the left"},
           [](const Profile& profile) { return std::vector{profile.crossings.front().energy_current()}; },
           energy},
          {{"kappa", "energy/(time temperature)", "-J_U N / (T_N - T_1); NaN without --cells"},
           [=](const Profile& profile) { return std::vector{conductivity(parameters, profile)}; }},
          {{"temperature_scatterer", "temperature", "<P^2>/M", {site}},
           at_every(scatterers,
                    [=](const Flux& flux) { return std::vector{flux.scatterer_temperature(sigma)}; })},
          {{"temperature_particle", "temperature", "<p^2> over the arrivals at a scatterer", {site}},
           at_every(scatterers, [](const Flux& flux) { return std::vector{flux.particle_temperature()}; })},
          {{"kurtosis", "1", "<p^4>/<p^2>^2 by direction; 3 for a Gaussian half", {x, half}},
           at_every(crossings, [](const Flux& flux) {
             return std::vector{flux.left.kurtosis(), flux.right.kurtosis()};
           })}};
}

std::vector<Description> descriptions(const Parameters& parameters) {
  std::vector<Description> result;
  for (const Definition& definition : definitions(parameters)) result.push_back(definition.what);
  return result;
}

double largest(const std::vector<double>& values) {
  double result = 0;
  for (const double value : values)
    if (std::isfinite(value)) result = std::max(result, std::abs(value));
  return result;
}

/// Largest difference over all positions and momenta, because two solutions cross at some of them; infinite
/// if only one of them is defined somewhere.
double difference(std::vector<double> a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::isfinite(a[i]) != std::isfinite(b[i])) return std::numeric_limits<double>::infinity();
    a[i] -= b[i];
  }
  return largest(a);
}

/// Values that state the errors, by quantity: of F first.
using Values = std::vector<std::vector<double>>;

/// Changes between the last four orders, or the last three, the latest first.
std::vector<double> changes(const std::vector<Values>& orders, std::size_t quantity) {
  std::vector<double> result;
  for (std::size_t k = orders.size() - 1; k > 0 && result.size() < 3; --k)
    result.push_back(difference(orders[k][quantity], orders[k - 1][quantity]));
  return result;
}

/// Factor by which changes fall from order to order, the larger one of the last two, but at most `slowest`.
double rate_of(const std::vector<double>& changes, double slowest) {
  if (changes.size() < 3) return slowest;
  double rate = 0;
  for (std::size_t k = 0; k < 2; ++k)
    if (changes[k] > 0) rate = std::max(rate, std::min(slowest, changes[k] / changes[k + 1]));
  return rate;
}

/// Bound on the changes to come: twice a geometric series. A single number may change little by chance, so
/// that former changes count, as far as they would have fallen.
double remainder(const std::vector<double>& changes, double rate) {
  double largest = 0, factor = 1;
  for (const double change : changes)
    largest = std::max(largest, std::exchange(factor, factor * rate) * change);
  return 2 * rate / (1 - rate) * largest;
}

/// The quantities at the last of at least three orders, with their errors. A number converges no slower than
/// F over all momenta. Where the series of F has not begun to converge, its error is at most ten times the
/// last change, which the slowest rate gives, and that of a number at most forty times.
Results results(const std::vector<Definition>& definitions, const Profile& profile,
                const std::vector<Values>& orders, double rounding) {
  Results results;
  constexpr double slowest = 0.85, slowest_of_numbers = 0.97;
  const double rate_of_flux = rate_of(changes(orders, 0), slowest);
  for (std::size_t k = 0; k < definitions.size(); ++k) {
    const std::vector<double> values = definitions[k].formula(profile);
    const std::size_t stating = definitions[k].has_error_of_flux ? 0 : k + 1;
    const std::vector<double> last = changes(orders, stating);
    const bool converging = stating == 0 || rate_of_flux < slowest;
    const double rate = converging ? rate_of_flux : std::max(slowest, rate_of(last, slowest_of_numbers));
    const double error =
        remainder(last, rate) + rounding * std::max(definitions[k].scale, largest(orders.back()[stating]));
    std::vector<double> errors;
    for (const double value : values) errors.push_back(std::isfinite(value) ? error : none);
    results.push_back({definitions[k].what, values, errors});
  }
  return results;
}

/// Largest error of F and its limits at p = 0, relative to the largest F of a bath, nu sqrt(2/(pi T)), and of
/// the currents. Currents may vanish: their errors are relative to the injected current over 1 + gamma if
/// that is larger.
double relative_error(const Parameters& parameters, const Results& results) {
  const auto error_of = [&](const char* name) {
    return largest(quantity_named(results, name).standard_error);
  };
  const KineticProblem problem = parameters.problem();
  const auto peak = [](const auto& bath) {
    return bath.rate * std::sqrt(2 / (std::numbers::pi * bath.temperature));
  };
  double error = std::max(error_of("flux_density"), error_of("jump")) /
                 std::max(peak(problem.left), peak(problem.right));
  for (const Definition& current : definitions(parameters))
    if (current.scale > 0)
      error = std::max(error, error_of(current.what.name.c_str()) /
                                  std::max(largest(quantity_named(results, current.what.name).mean),
                                           current.scale / (1 + problem.gamma)));
  return error;
}

/// Raises the order by factors of 3/2 until the target is reached. Orders are even, as the errors at even and
/// at odd ones differ.
RunResult solve(const Parameters& parameters, Progress& progress) try {
  constexpr std::size_t lowest = 8, highest = 700;
  constexpr double rounding = 5e-14;
  const std::vector<Definition> quantities = definitions(parameters);
  const Definition::Formula flux = flux_for_errors(parameters);
  std::vector<Values> orders;
  std::unique_ptr<KineticSolution> solution;
  RunResult outcome{.target_quantity = "flux and currents", .target_error = parameters.target_error};
  for (std::size_t order = lowest; order < highest; order = 3 * order / 4 * 2) try {
      const auto show = [&](double step) {
        if (!progress.due()) return;
        const std::string error =
            outcome.results.empty() ? "not known yet" : fmt::format("{:.1e}", outcome.achieved_error);
        progress.say(fmt::format("the series converges slowly: error {}; order {} of at most {}, step {:.1e}",
                                 error, order, highest, step));
      };
      solution = std::make_unique<KineticSolution>(parameters.problem(), order, solution.get(), show);
      outcome.events += static_cast<std::uint64_t>(solution->evaluations());
      const Profile stating(parameters, Parameters().positions, *solution);
      Values& values = orders.emplace_back(1, flux(stating));
      for (const Definition& quantity : quantities)
        values.push_back(quantity.has_error_of_flux ? std::vector<double>() : quantity.formula(stating));
      if (orders.size() < 3) continue;
      outcome.results = results(quantities, Profile(parameters, parameters.positions, *solution), orders,
                                rounding + solution->iteration_error());
      outcome.achieved_error = relative_error(parameters, outcome.results);
      if (outcome.achieved_error > parameters.target_error) continue;
      outcome.convergence = Convergence::reached;
      return outcome;
    } catch (const ConvergenceError&) {
      if (outcome.results.empty()) throw;
      break;  // the results of the last order state their errors
    }
  progress.say(
      fmt::format("target not reached: F and the currents are known to {:.1e}, not to {:.1e}, because their "
                  "series converge slowly; choose a larger --target-error, baths that differ less, or sigma "
                  "farther from -1, 0 and 1",
                  outcome.achieved_error, parameters.target_error));
  return outcome;
} catch (const ConvergenceError& error) {
  throw NumericalError(error.what());
}

}  // namespace

int main(int argc, char** argv) {
  Program program("boltzmann", "Kinetic equation of the open chain, solved to a given accuracy");
  Parameters parameters;
  declare(program.options(), parameters);
  const auto quantities = [&] {
    validate(parameters, program.options().given("--positions"));
    return descriptions(parameters);
  };
  return program.run(argc, argv, quantities, [&] {
    const RunResult result = solve(parameters, program.progress());
    if (const std::string reason = reason_without_kappa(parameters); parameters.cells && !reason.empty())
      program.progress().say(fmt::format("kappa is NaN: {}", reason));
    return program.write(result);
  });
}
