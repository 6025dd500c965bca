/// Solution of the kinetic (Boltzmann) equation of the open chain, the limit of infinitely many cells and
/// particles at fixed gamma, in which a particle and the scatterer that it reaches are independent [eq. 36],
///
///   sign(p) dF/dx = gamma [ int dU F(u') g(U') - F ],   g(U) int F du = int du F(u') g(U'),   0 < x < 1,
///
/// with F(p > 0) at x = 0 and F(p < 0) at x = 1 given by the reservoirs (half-Gaussian) [eq. 5]. With --cells
/// it is solved for a chain of N scatterers, each with its own F and g (mean field) [eq. 41].
///
/// The result is deterministic. The error of a quantity is the sum of the changes with the order of the
/// series that are still to come, if they fall as the last two did, and rounding.
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
#include <vector>

#include "boltzmann/kinetic_equation.hpp"
#include "program/program.hpp"
#include "sampling/chain_parameters.hpp"
#include "sampling/momentum_bins.hpp"

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

/// Flux at the positions of the output.
struct Profile {
  std::vector<Flux> crossings, scatterers;

  Profile(const Parameters& parameters, const KineticSolution& solution) {
    if (!parameters.cells) {
      for (const double x : parameters.positions) crossings.push_back(solution.at(x));
      scatterers = crossings;
      return;
    }
    for (std::size_t bond = 0; bond <= *parameters.cells; ++bond) crossings.push_back(solution.at_bond(bond));
    for (std::size_t site = 0; site < *parameters.cells; ++site)
      scatterers.push_back(solution.at_scatterer(site));
  }
};

/// Quantity with its formula, and the scale of its rounding error: its largest value, but for currents, which
/// may vanish, what both baths inject.
struct Definition {
  using Formula = std::function<std::vector<double>(const Profile&)>;
  Description what;
  Formula formula;
  double scale = 0;
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

/// -J_U N/(T_N - T_1) [eq. 28]; NaN in the continuum and without a difference of temperatures.
double conductivity(const Parameters& parameters, const Profile& profile) {
  const double first = profile.scatterers.front().scatterer_temperature(parameters.sigma),
               rise = profile.scatterers.back().scatterer_temperature(parameters.sigma) - first;
  if (!parameters.cells || !(std::abs(rise) > 1e-10 * first)) return none;
  return -profile.crossings.front().energy_current() * *parameters.cells / rise;
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
  const auto mean_flux = [=](const Flux& flux) {
    std::vector<double> values;
    for (std::size_t bin = 0; bin < bins.count(); ++bin) {
      const double low = bins.edge(bin), high = bins.edge(bin + 1);
      values.push_back((low < 0 ? flux.left.integral(-low) - flux.left.integral(-high)
                                : flux.right.integral(high) - flux.right.integral(low)) /
                       bins.width());
    }
    return values;
  };
  const auto density = [=](const Flux& flux) {
    std::vector<double> values;
    for (const double p : momentum.values)
      values.push_back(p < 0 ? flux.left.density(-p) : flux.right.density(p));
    return values;
  };
  const auto kurtosis = [](const Flux& flux) {
    std::vector<double> values;
    for (const HalfFlux* side : {&flux.left, &flux.right}) {
      const double value = side->moment(4) * side->moment(0) / (side->moment(2) * side->moment(2));
      values.push_back(std::isfinite(value) ? value : none);
    }
    return values;
  };
  const auto first = [](auto number) {
    return [=](const Profile& profile) { return std::vector{number(profile.crossings.front())}; };
  };
  const auto crossings = &Profile::crossings, scatterers = &Profile::scatterers;
  return {{{"flux", "1/(time momentum)", "F(p, x), mean over a bin of p", {x, momentum}},
           at_every(crossings, mean_flux)},
          {{"flux_density", "1/(time momentum)", "F(p, x)", {x, momentum}}, at_every(crossings, density)},
          {{"jump", "1/(time momentum)", "F at p = 0+ minus p = 0-", {x}},
           at_every(crossings, [](const Flux& flux) { return std::vector{flux.jump()}; })},
          {{"particle_current", "1/time", "Particles to the right minus to the left"},
           first([](const Flux& flux) { return flux.particle_current(); }),
           particles},
          {{"energy_current", "energy/time", "Energy to the right minus to the left"},
           first([](const Flux& flux) { return flux.energy_current(); }),
           energy},
          {{"kappa", "energy/(time temperature)", "-J_U N / (T_N - T_1); NaN without --cells"},
           [=](const Profile& profile) { return std::vector{conductivity(parameters, profile)}; }},
          {{"temperature_scatterer", "temperature", "<P^2>/M", {site}},
           at_every(scatterers,
                    [=](const Flux& flux) { return std::vector{flux.scatterer_temperature(sigma)}; })},
          {{"temperature_particle", "temperature", "<p^2> over the arrivals at a scatterer", {site}},
           at_every(scatterers, [](const Flux& flux) { return std::vector{flux.particle_temperature()}; })},
          {{"kurtosis", "1", "<p^4>/<p^2>^2 by direction; 3 for a Gaussian half", {x, half}},
           at_every(crossings, kurtosis)}};
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

/// Bound on the error of the last of three values: the sum of a geometric series of changes, where the orders
/// increase by one factor. A tenth of the former change, if it is larger than the last one, as two solutions
/// may agree by chance.
double remainder(const std::vector<double>& first, const std::vector<double>& second,
                 const std::vector<double>& last) {
  const double former = difference(second, first), change = difference(last, second);
  const double ratio = former > 0 ? std::min(change / former, 0.99) : 0.;
  return std::max(change, 0.1 * former) / (1 - ratio);
}

/// Values of all quantities, in the order of the definitions.
using Values = std::vector<std::vector<double>>;

Values evaluate(const std::vector<Definition>& definitions, const Profile& profile) {
  Values values;
  for (const Definition& definition : definitions) values.push_back(definition.formula(profile));
  return values;
}

/// The quantities at the last of at least three orders, with their errors.
Results results(const std::vector<Definition>& definitions, const std::vector<Values>& orders,
                double rounding) {
  Results results;
  for (std::size_t k = 0; k < definitions.size(); ++k) {
    const std::vector<double>& values = orders.back()[k];
    const double error = remainder(orders[orders.size() - 3][k], orders[orders.size() - 2][k], values) +
                         rounding * std::max(definitions[k].scale, largest(values));
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
  std::vector<Values> orders;
  std::unique_ptr<KineticSolution> solution;
  RunResult outcome{.target_quantity = "flux and currents", .target_error = parameters.target_error};
  for (std::size_t order = lowest; order < highest; order = 3 * order / 4 * 2) try {
      solution = std::make_unique<KineticSolution>(parameters.problem(), order, solution.get());
      outcome.events += static_cast<std::uint64_t>(solution->evaluations());
      orders.push_back(evaluate(quantities, Profile(parameters, *solution)));
      if (orders.size() < 3) continue;
      outcome.results = results(quantities, orders, rounding + solution->iteration_error());
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
  return program.run(argc, argv, quantities,
                     [&] { return program.write(solve(parameters, program.progress())); });
}
