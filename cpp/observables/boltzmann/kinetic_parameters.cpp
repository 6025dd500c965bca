#include "observables/boltzmann/kinetic_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "program/errors.hpp"
#include "sampling/chain_parameters.hpp"

namespace lorentz {

using Eigen::Index;
using Eigen::VectorXd;

KineticProblem KineticParameters::problem() const {
  KineticProblem problem;
  problem.sigma = sigma;
  problem.gamma = gamma.value_or(cells.value_or(0));
  problem.left = left;
  problem.right = right;
  problem.cells = static_cast<int>(cells.value_or(0));
  return problem;
}

FieldGrid KineticParameters::grid() const {
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

void declare(Options& options, KineticParameters& parameters) {
  options.real("--sigma", parameters.sigma, {-0.99, 0.99}, "1", "Mass ratio (M-m)/(M+m)");
  options.real_or_word("--gamma", parameters.gamma, {0, 1000}, "N", "1",
                       "Mean number of scatterings on the way through; N: one at each of --cells");
  options.integer_or_word("--cells", parameters.cells, {1, 300}, "continuum",
                          "Number of scatterers of a mean-field chain");
  declare(options, parameters.rule);
  declare(options, parameters.left, parameters.right);
  options.ascending_list("--positions", parameters.positions, {0, 1}, "1",
                         "Positions of the continuum's output, over the length of the chain");
  declare(options, parameters.bins);
  options.real("--target-error", parameters.target_error, non_negative, "1",
               "Relative error of the currents at which the resolution suffices");
  options.integer("--coarsening", parameters.coarsening, {0, 4},
                  "Levels below the usual one at which the refinement begins");
}

void validate(const KineticParameters& parameters, bool positions_given) {
  validate(parameters.bins);
  validate(parameters.rule);
  if (!parameters.rule.properties().kinetic_equation)
    throw UsageError(fmt::format(
        "--rule {}: its kinetic equation is not solved here. Choose --rule {}, or simulate the chain.",
        parameters.rule.name, Elastic::properties.name));
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

}  // namespace lorentz
