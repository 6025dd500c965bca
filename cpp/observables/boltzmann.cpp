/// Solution of the kinetic (Boltzmann) equation of the open chain, the limit of infinitely many cells and
/// particles at fixed gamma, in which a particle and the scatterer that it reaches are independent [eq. 36],
///
///   sign(p) dF/dx = gamma [ int dU F(u') g(U') - F ],   g(U) int F du = int du F(u') g(U'),   0 < x < 1,
///
/// with F(p > 0) at x = 0 and F(p < 0) at x = 1 given by the reservoirs (half-Gaussian) [eq. 5]. With --cells
/// it is solved for a chain of N scatterers, each with its own F and g (mean field) [eq. 41].
///
/// The result is deterministic. The error of a quantity is its difference from the solution one resolution
/// level below, plus rounding. The former is the error of the coarser solution, so the accuracy is limited by
/// the latter.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "boltzmann/fields.hpp"
#include "boltzmann/moments.hpp"
#include "boltzmann/refinement.hpp"
#include "model/reservoir.hpp"
#include "program/program.hpp"
#include "sampling/chain_parameters.hpp"
#include "sampling/momentum_bins.hpp"

namespace {

using namespace lorentz;
using Eigen::Index;
using Eigen::VectorXd;

/// Defaults: figure 3 of the paper.
struct Parameters {
  double sigma = 0.5;
  std::optional<double> gamma = 1;       // none: N, one scattering at each of the cells
  std::optional<std::uint32_t> cells{};  // none: continuum
  Reservoir left = default_left, right = default_right;
  std::vector<double> positions{0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1};
  MomentumBinParameters bins;
  double target_error = 1e-10;
  std::uint32_t coarsening = 0;

  KineticProblem problem() const;
  FieldGrid grid() const;  // of the output: --positions, or the bonds and scatterers of a chain
};

KineticProblem Parameters::problem() const {
  KineticProblem problem;
  problem.sigma = sigma;
  problem.gamma = gamma.value_or(cells.value_or(0));
  problem.left = left;
  problem.right = right;
  problem.cells = static_cast<int>(cells.value_or(0));
  return problem;
}

FieldGrid Parameters::grid() const {
  const Bins p = bins.bins();
  const std::vector<double> middles = p.middles();
  const auto half = static_cast<Index>(p.count() / 2);
  FieldGrid grid{.crossings = VectorXd::Map(positions.data(), static_cast<Index>(positions.size())),
                 .scatterers = {},
                 .edges = VectorXd::LinSpaced(half + 1, 0, p.edge(p.count())),
                 .middles = VectorXd::Map(middles.data() + half, half),
                 .bin_width = p.width(),
                 .root_mass = std::sqrt((1 + sigma) / (1 - sigma))};
  grid.scatterers = grid.crossings;
  if (cells) {
    const Index sites = *cells;
    grid.crossings = VectorXd::LinSpaced(sites + 1, 0, 1);
    grid.scatterers = 0.5 * (grid.crossings.head(sites) + grid.crossings.tail(sites));
  }
  return grid;
}

void declare(Options& options, Parameters& parameters) {
  options.real("--sigma", parameters.sigma, {-0.99, 0.99}, "1", "Mass ratio (M-m)/(M+m)");
  options.real_or_word("--gamma", parameters.gamma, {0, 100}, "N", "1",
                       "Mean number of scatterings on the way through; N: one at each of --cells");
  options.integer_or_word("--cells", parameters.cells, {1, 100}, "continuum",
                          "Number of scatterers of a mean-field chain");
  declare(options, parameters.left, parameters.right);
  options.ascending_list("--positions", parameters.positions, {0, 1}, "1",
                         "Positions of the continuum's output, over the length of the chain");
  declare(options, parameters.bins);
  options.real("--target-error", parameters.target_error, non_negative, "1",
               "Relative error of the currents at which the resolution suffices");
  options.integer("--coarsening", parameters.coarsening, {0, 4},
                  "Levels below the usual one at which the refinement begins");
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

/// Quantity with its formula.
struct Definition {
  Description what;
  std::function<std::vector<double>(const KineticFields&)> formula;
};

std::vector<Definition> definitions(const Parameters& parameters) {
  const FieldGrid grid = parameters.grid();
  const auto values = [](const VectorXd& x) { return std::vector<double>(x.begin(), x.end()); };
  const Axis x{"x", "1", "Position over the length of the chain; bonds of a chain of cells",
               values(grid.crossings)};
  const Axis site{"x", "1", "Position over the length of the chain; scatterers of a chain of cells",
                  values(grid.scatterers)};
  const Axis momentum = momentum_axis(parameters.bins.bins());
  Axis scatterer_momentum{"momentum", "momentum", "P, the particle's times sqrt(M)", momentum.values};
  for (double& value : scatterer_momentum.values) value *= grid.root_mass;
  const Axis half{"half", "1", "Sign of p", {-1, 1}};
  const auto array = [](auto member) {
    return [member](const KineticFields& fields) {
      const auto& matrix = fields.*member;
      return std::vector<double>(matrix.data(), matrix.data() + matrix.size());
    };
  };
  const auto number = [](double KineticFields::* member) {
    return [member](const KineticFields& fields) { return std::vector{fields.*member}; };
  };
  using F = KineticFields;
  return {
      {{"flux", "1/(time momentum)", "F(p, x), mean over a bin of p", {x, momentum}}, array(&F::flux)},
      {{"flux_density", "1/(time momentum)", "F(p, x)", {x, momentum}}, array(&F::flux_density)},
      {{"scatterer_density", "1/momentum", "g(P, x), probability density", {site, scatterer_momentum}},
       array(&F::scatterer_density)},
      {{"particle_current", "1/time", "Particles to the right minus to the left"},
       number(&F::particle_current)},
      {{"energy_current", "energy/time", "Energy to the right minus to the left"},
       number(&F::energy_current)},
      {{"kappa", "energy/(time temperature)", "-J_U N / (T_N - T_1); NaN without --cells"},
       number(&F::conductivity)},
      {{"current_spread", "1", "Largest deviation of a current over x, relative to what the baths inject"},
       number(&F::current_spread)},
      {{"temperature_scatterer", "temperature", "<P^2>/M", {site}}, array(&F::scatterer_temperature)},
      {{"temperature_particle", "temperature", "<p^2> over the arrivals at a scatterer", {site}},
       array(&F::particle_temperature)},
      {{"rate_right", "1/time", "Crossings to the right", {x}}, array(&F::rate_right)},
      {{"rate_left", "1/time", "Crossings to the left", {x}}, array(&F::rate_left)},
      {{"jump", "1/(time momentum)", "F at p = 0+ minus p = 0-", {x}}, array(&F::jump)},
      {{"kurtosis", "1", "<p^4>/<p^2>^2 by direction; 3 for a Gaussian half", {x, half}},
       array(&F::kurtosis)}};
}

const Description momentum_points{"momentum_points", "1", "Points in momentum, both halves together"};

std::vector<Description> descriptions(const Parameters& parameters) {
  std::vector<Description> result;
  for (const Definition& definition : definitions(parameters)) result.push_back(definition.what);
  result.push_back(momentum_points);
  return result;
}

/// Scale of a quantity's rounding error. For currents, which may vanish, it is the injected current.
double rounding_scale(const KineticProblem& problem, const std::string& name,
                      const std::vector<double>& values) {
  const auto [particles, energy, momentum] = injected(problem.left, problem.right);
  if (name == "particle_current") return particles;
  if (name == "energy_current") return energy;
  double largest = 0;
  for (const double value : values)
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  return largest;
}

/// Largest difference over all positions and momenta, because two solutions cross at some of them.
double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::isfinite(a[i])) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

Results results(const Parameters& parameters, const RefinedSolution& solution) {
  constexpr double rounding = 5e-14;  // relative to the rounding scale
  const KineticProblem problem = parameters.problem();
  const FieldGrid grid = parameters.grid();
  const KineticFields fine(problem, *solution.fine, grid), coarse(problem, *solution.coarse, grid);
  Results results;
  for (const Definition& definition : definitions(parameters)) {
    const std::vector<double> values = definition.formula(fine);
    const double error = largest_difference(values, definition.formula(coarse)) +
                         rounding * rounding_scale(problem, definition.what.name, values);
    std::vector<double> errors(values.size(), error);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!std::isfinite(values[i])) errors[i] = std::numeric_limits<double>::quiet_NaN();
    results.push_back({definition.what, values, errors});
  }
  results.push_back({momentum_points,
                     {static_cast<double>(2 * solution.fine->momenta().size())},
                     {std::numeric_limits<double>::quiet_NaN()}});
  return results;
}

RunResult solve(const Parameters& parameters, Progress& progress) try {
  const double target = parameters.target_error;
  const RefinedSolution solution =
      refine(parameters.problem(), target, static_cast<int>(parameters.coarsening));
  const bool reached = solution.error <= target;
  if (!reached)
    progress.say(fmt::format("target not reached: the currents are known to {:.1e}, not to {:.1e}",
                             solution.error, target));
  return {.results = results(parameters, solution),
          .events = static_cast<std::uint64_t>(solution.evaluations),
          .target_quantity = "currents",
          .target_error = target,
          .achieved_error = solution.error,
          .convergence = reached ? Convergence::reached : Convergence::not_reached};
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
