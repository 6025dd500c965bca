/// Solution of the kinetic (Boltzmann) equation of the open chain, the limit of infinitely many cells and
/// particles at fixed gamma, in which a particle and the scatterer that it reaches are independent [eq. 35],
///
///   sign(p) dF/dx = gamma [ int dU F(u') g(U') - F ],   g(U) int F du = int du F(u') g(U'),   0 < x < 1,
///
/// with F(p > 0) at x = 0 and F(p < 0) at x = 1 given by the reservoirs (half-Gaussian) [eq. 5]. With --cells
/// it is solved for a chain of N scatterers, each with its own F and g (mean field) [eq. 39].
///
/// The result is deterministic. The error of a quantity is twice the sum of the changes with the order of the
/// series that are still to come, if they fall as those of F did, and rounding.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "boltzmann/kinetic_equation.hpp"
#include "model/conduction.hpp"
#include "program/program.hpp"
#include "sampling/momentum_bins.hpp"
#include "sampling/reservoir_parameters.hpp"

namespace {

using namespace lorentz;

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
        "--gamma N needs --cells: the continuum has no number of cells. Give --cells, or gamma as a number.");
  if (parameters.cells) require_probability(parameters.gamma, *parameters.cells);
  if (parameters.cells && positions_given)
    throw UsageError(
        "--positions and --cells are both given: a chain's output is at its bonds. Leave out one of them.");
  if (parameters.left.rate + parameters.right.rate == 0)
    throw UsageError("--nu-left and --nu-right are both 0: there are no particles. Choose one above 0.");
}

/// Why a chain has no conductivity; empty if it has one.
std::string reason_without_kappa(const Parameters& parameters) {
  if (*parameters.cells == 1) return "a single cell has no difference of temperature; choose more --cells";
  return reason_without_conduction(parameters.left, parameters.right, parameters.problem().gamma,
                                   parameters.sigma, parameters.sigma != 0);
}

/// Bonds of a chain, or else `positions` of the continuum.
std::vector<double> bonds_or(const std::vector<double>& positions, const Parameters& parameters) {
  if (!parameters.cells) return positions;
  std::vector<double> bonds;
  for (std::uint32_t bond = 0; bond <= *parameters.cells; ++bond)
    bonds.push_back(bond / static_cast<double>(*parameters.cells));
  return bonds;
}

/// The quantities, in the order of Values and of lists of errors.
std::vector<Description> descriptions(const Parameters& parameters) {
  const Axis x{"x", "1", "Position over the length of the chain; bonds of a chain of cells",
               bonds_or(parameters.positions, parameters)};
  const Axis momentum = momentum_axis(parameters.bins.bins());
  const Axis half{"half", "1", "Sign of p", {-1, 1}};
  return {{"flux_density", "1/(time momentum)", "F(p, x)", {x, momentum}},
          {"jump", "1/(time momentum)", "F at p = 0+ minus p = 0-", {x}},
          {"kurtosis", "1", "<p^4>/<p^2>^2 by direction; 3 for a Gaussian half", {x, half}},
          {"particle_current", "1/time", "Particles to the right minus to the left"},
          {"energy_current", "energy/time", "Energy to the right minus to the left"},
          {"kappa", "energy/(time temperature)", "-J_U N / (T_N - T_1); NaN without --cells"},
          {"flux", "1/(time momentum)", "F(p, x), mean over a bin of p", {x, momentum}}};
}

/// Values of a quantity, and of a current also what the baths inject, which both directions add to.
struct Value {
  std::vector<double> mean;
  double injected = 0;
};
using Values = std::vector<Value>;

/// -J_U N/(T_N - T_1) [eq. 27].
double conductivity(const Parameters& parameters, const KineticSolution& solution) {
  if (!parameters.cells || !reason_without_kappa(parameters).empty()) return std::nan("");
  const Flux first = solution.at_scatterer(0), last = solution.at_scatterer(*parameters.cells - 1);
  return -solution.at(0).energy_current() * *parameters.cells /
         (last.scatterer_temperature(parameters.sigma) - first.scatterer_temperature(parameters.sigma));
}

/// All quantities but the mean of F over bins.
Values evaluate(const Parameters& parameters, const KineticSolution& solution,
                const std::vector<double>& positions, const std::vector<double>& momenta) {
  std::vector<double> density, jump, kurtosis;
  for (const double x : positions) {
    const Flux flux = solution.at(x);
    for (const double p : momenta) density.push_back(flux.density(p));
    jump.push_back(flux.jump());
    kurtosis.insert(kurtosis.end(), {flux.left.kurtosis(), flux.right.kurtosis()});
  }
  const Flux first = solution.at(positions.front());
  const Reservoir &left = parameters.left, &right = parameters.right;
  const double energy = left.rate * left.mean_energy() + right.rate * right.mean_energy();
  return {{density},
          {jump},
          {kurtosis},
          {{first.particle_current()}, left.rate + right.rate},
          {{first.energy_current()}, energy},
          {{conductivity(parameters, solution)}}};
}

/// The quantities at positions and momenta that do not depend on the output: F at p = 0+ and 0-, and up to
/// six thermal momenta of either bath, in steps that resolve the highest order.
Values evaluate_for_errors(const Parameters& parameters, const KineticSolution& solution) {
  std::vector<double> momenta;
  for (const double temperature : {parameters.left.temperature, parameters.right.temperature})
    for (int k = 0; k <= 96; ++k)
      for (const int sign : {1, -1}) momenta.push_back(sign * (k / 16. * std::sqrt(temperature)));
  return evaluate(parameters, solution, bonds_or(Parameters().positions, parameters), momenta);
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

/// Changes of a quantity between the last four orders, or the last three, the latest first.
std::vector<double> changes(const std::vector<Values>& orders, std::size_t quantity) {
  std::vector<double> result;
  for (std::size_t k = orders.size() - 1; k > 0 && result.size() < 3; --k)
    result.push_back(difference(orders[k][quantity].mean, orders[k - 1][quantity].mean));
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
  for (const double change : changes) {
    largest = std::max(largest, factor * change);
    factor *= rate;
  }
  return 2 * rate / (1 - rate) * largest;
}

/// Errors of the quantities, of F first, at the last of at least three orders. A number converges no slower
/// than F over all momenta. Where the series of F has not begun to converge, its error is at most ten times
/// the last change, which the slowest rate gives, and that of a number at most forty times. Rounding is
/// relative to the largest value, or to the injected current, as currents may vanish.
std::vector<double> errors(const std::vector<Values>& orders, double rounding) {
  constexpr double slowest = 0.85, slowest_of_numbers = 0.97;
  const double rate_of_flux = rate_of(changes(orders, 0), slowest);
  std::vector<double> result;
  for (std::size_t k = 0; k < orders.back().size(); ++k) {
    const auto& [mean, injected] = orders.back()[k];
    const std::vector<double> latest = changes(orders, k);
    const bool converging = k == 0 || rate_of_flux < slowest;
    const double rate = converging ? rate_of_flux : std::max(slowest, rate_of(latest, slowest_of_numbers));
    result.push_back(remainder(latest, rate) + rounding * std::max(injected, largest(mean)));
  }
  return result;
}

/// Largest error of F and its jump, relative to the largest F of a bath, and of the currents. Currents may
/// vanish: their errors are relative to the injected current over 1 + gamma if that is larger.
double relative_error(const Parameters& parameters, const Values& values, const std::vector<double>& errors) {
  const auto peak = [](const Reservoir& bath) { return HalfFlux{bath, 1, {}}.density(0); };
  const double gamma = parameters.problem().gamma;
  double result = std::max(errors[0], errors[1]) / std::max(peak(parameters.left), peak(parameters.right));
  for (std::size_t k = 0; k < values.size(); ++k)
    if (const auto& [mean, injected] = values[k]; injected > 0)
      result = std::max(result, errors[k] / std::max(largest(mean), injected / (1 + gamma)));
  return result;
}

Results results(const Parameters& parameters, const KineticSolution& solution, std::vector<double> errors) {
  const std::vector<Description> what = descriptions(parameters);
  const std::vector<double> positions = bonds_or(parameters.positions, parameters);
  const Bins bins = parameters.bins.bins();
  Values values = evaluate(parameters, solution, positions, bins.middles());
  values.emplace_back();
  for (const double x : positions) {
    const Flux flux = solution.at(x);
    for (std::size_t bin = 0; bin < bins.count(); ++bin)
      values.back().mean.push_back(flux.integral(bins.edge(bin), bins.edge(bin + 1)) / bins.width());
  }
  errors.push_back(errors.front());  // a mean of F has the error of F
  Results results;
  for (std::size_t k = 0; k < what.size(); ++k) {
    std::vector<double> error;
    for (const double value : values[k].mean)
      error.push_back(std::isfinite(value) ? errors[k] : std::nan(""));
    results.push_back({what[k], values[k].mean, error});
  }
  return results;
}

/// Raises the order by factors of 3/2 until the target is reached. Orders are even, as the errors at even and
/// at odd ones differ.
RunResult solve(const Parameters& parameters, Progress& progress) {
  constexpr std::size_t lowest = 8, highest = 700;
  constexpr double rounding = 5e-14;
  RunResult outcome{.target_quantity = "flux and currents", .target_error = parameters.target_error};
  std::unique_ptr<KineticSolution> solution;
  std::vector<Values> orders;
  std::vector<double> error;  // of the quantities, from the third order on
  for (std::size_t order = lowest; order < highest; order = 3 * order / 4 * 2) try {
      int iteration = 0;
      const auto show = [&](double step) {
        ++iteration;
        if (!progress.due()) return;
        progress.say(fmt::format(
            "order {} of at most {}: iteration {}, step {:.1e}; error {}", order, highest, iteration, step,
            error.empty() ? "not known yet" : fmt::format("{:.1e}", outcome.achieved_error)));
      };
      solution = std::make_unique<KineticSolution>(parameters.problem(), order, solution.get(), show);
      outcome.events += static_cast<std::uint64_t>(solution->evaluations());
      orders.push_back(evaluate_for_errors(parameters, *solution));
      if (orders.size() < 3) continue;
      error = errors(orders, rounding + solution->iteration_error());
      outcome.achieved_error = relative_error(parameters, orders.back(), error);
      if (outcome.achieved_error > parameters.target_error) continue;
      outcome.convergence = Convergence::reached;
      break;
    } catch (const ConvergenceError& failure) {
      if (error.empty()) throw NumericalError(failure.what());
      break;  // the last solution has an error
    }
  outcome.results = results(parameters, *solution, error);
  if (outcome.convergence == Convergence::not_reached)
    progress.say(fmt::format(
        "target not reached: the error of F and the currents is {:.1e}, as their series converge slowly; "
        "choose a larger --target-error, baths that differ less, or sigma farther from -1, 0 and 1",
        outcome.achieved_error));
  return outcome;
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
    const std::string reason = parameters.cells ? reason_without_kappa(parameters) : "";
    if (!reason.empty()) program.progress().say(fmt::format("kappa is NaN: {}", reason));
    return program.write(result);
  });
}
