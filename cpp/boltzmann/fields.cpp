#include "boltzmann/fields.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "boltzmann/moments.hpp"

namespace lorentz {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

/// Joins values at p > 0 and at p < 0, both in ascending order of |p|, to columns in ascending order of p.
MatrixXd ascending(const MatrixXd& right, const MatrixXd& left) {
  MatrixXd result(right.rows() + left.rows(), right.cols());
  result << left.colwise().reverse(), right;
  return result;
}

MatrixXd on_half_lines(const MatrixXd& matrix, const Flux& flux) {
  return ascending(matrix * flux.topRows(matrix.cols()), matrix * flux.bottomRows(matrix.cols()));
}

double spread(const KineticProblem& problem, const Currents& currents) {
  const auto scale = injected(problem.left, problem.right);
  double largest = 0;
  for (Index i = 0; i < currents.particles.size(); ++i)
    for (std::size_t n = 0; n < scale.size(); ++n)
      largest = std::max(largest, std::abs(currents.values(i)[n] - currents.values(0)[n]) / scale[n]);
  return largest;
}

}  // namespace

KineticFields::KineticFields(const KineticProblem& problem, const KineticSolution& solution,
                             const FieldGrid& grid) {
  const Panels& momenta = solution.momenta();
  const Flux at_crossings = solution.flux(grid.crossings), arriving = solution.flux(grid.scatterers);
  const HalfMoments moments(momenta, at_crossings), arrivals(momenta, arriving);
  const Currents currents(moments);

  const MatrixXd integrals = momenta.integration(grid.edges);
  const Index bins = integrals.rows() - 1;
  const MatrixXd means = (integrals.bottomRows(bins) - integrals.topRows(bins)) / grid.bin_width;
  const MatrixXd density = solution.scatterer_density(grid.scatterers, grid.middles) / grid.root_mass;
  flux = on_half_lines(means, at_crossings);
  flux_density = on_half_lines(momenta.interpolation(grid.middles), at_crossings);
  scatterer_density = ascending(density.topRows(bins), density.bottomRows(bins));

  particle_current = currents.particles.mean();
  energy_current = currents.energy.mean();
  current_spread = spread(problem, currents);

  particle_temperature = arrivals.whole(2).array() / arrivals.whole(0).array();
  const RowVectorXd mean = arrivals.whole(1).array() / arrivals.whole(0).array();
  const double push = grid.root_mass * grid.root_mass - 1;  // M - 1 [eq. 39]
  scatterer_temperature = particle_temperature.array() + push * mean.array().square();

  const double first = scatterer_temperature(0), rise = scatterer_temperature.tail(1)(0) - first;
  const bool defined = problem.cells > 1 && std::abs(rise) > 1e-10 * first;
  conductivity = defined ? -energy_current * problem.cells / rise : std::numeric_limits<double>::quiet_NaN();

  rate_right = moments.right(0);
  rate_left = moments.left(0);
  jump = momenta.interpolation(VectorXd::Zero(1)) *
         (at_crossings.topRows(momenta.size()) - at_crossings.bottomRows(momenta.size()));
  kurtosis.resize(2, at_crossings.cols());
  kurtosis.row(0) = moments.left(4).array() * rate_left.array() / moments.left(2).array().square();
  kurtosis.row(1) = moments.right(4).array() * rate_right.array() / moments.right(2).array().square();
  kurtosis = kurtosis.array().isFinite().select(kurtosis, std::numeric_limits<double>::quiet_NaN());
}

}  // namespace lorentz
