/// Solution of the kinetic (Boltzmann) equation of the open chain: the limit of many cells at fixed gamma,
/// and of many particles, in which a particle and the scatterer that it meets are independent,
///
///   sign(p) dF/dx = gamma [ int dU F(u') g(U') - F ],   g(U) int F du = int du F(u') g(U'),   0 < x < 1,
///
/// with F(p > 0) given at x = 0 and F(p < 0) at x = 1 by the reservoirs (half-Gaussian). With --cells the
/// same for a chain of N scatterers, each with its own F and g (mean field).
///
/// There is no chance in it. The error of every number is its difference from the solution at half the
/// resolution, plus rounding; the former belongs to the coarser of the two, so the latter is what limits the
/// result.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "boltzmann/moments.hpp"
#include "boltzmann/refinement.hpp"
#include "observables/momentum_bins_options.hpp"
#include "observables/physics_options.hpp"
#include "program/interruption.hpp"
#include "program/program.hpp"

namespace {

using namespace lorentz;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

constexpr double every_scatterer = std::numeric_limits<double>::infinity();  // --gamma N
constexpr double rounding = 5e-14;  // relative to the largest value of a quantity

class ProblemOptions {
 public:
  explicit ProblemOptions(const Options& options) : options_(options) {}

  void declare(Options& options) {
    options.real("--sigma", problem_.sigma, {-0.99, 0.99}, "Mass ratio (M-m)/(M+m)");
    options.real_or_word("--gamma", problem_.gamma, {0, 1000}, "N", every_scatterer,
                         "Mean number of scatterings on the way through; N: one at each of --cells");
    options.real_or_word("--cells", cells_, {1, 300}, "continuum", 0,
                         "Number of scatterers of a mean-field chain");
    add_reservoir_options(options, problem_.left, problem_.right);
    options.ascending_list("--positions", positions_, {0, 1}, "Where the continuum is asked for its state");
  }

  /// Throws UsageError where options are possible one by one but not together.
  void validate() const {
    if (cells_ != std::floor(cells_))
      throw UsageError("--cells is not a whole number. Give the number of scatterers, or continuum.");
    if (cells_ == 0 && problem_.gamma == every_scatterer)
      throw UsageError("--gamma N needs a chain. Give --cells, or gamma as a number.");
    if (cells_ > 0 && problem().gamma > cells_)
      throw UsageError(
          "--gamma exceeds --cells: gamma/N is a probability. Choose more cells or a smaller gamma.");
    if (cells_ > 0 && options_.given("--positions"))
      throw UsageError("--positions belongs to the continuum: a chain has bonds. Leave out one of the two.");
    require_fourth_powers(problem_.left, problem_.right);
    require_within(problem_.left.rate + problem_.right.rate, 0, 1e100, "--nu-left, --nu-right", "their sum");
    if (problem_.left.rate + problem_.right.rate == 0)
      throw UsageError(
          "--nu-left and --nu-right are both 0: there are no particles. Choose one greater than 0.");
  }

  KineticProblem problem() const {
    KineticProblem problem = problem_;
    problem.cells = static_cast<int>(cells_);
    if (problem.gamma == every_scatterer) problem.gamma = cells_;
    return problem;
  }

  /// Where the flux is asked for: at the bonds of a chain.
  VectorXd crossings() const {
    if (cells_ > 0) return VectorXd::LinSpaced(static_cast<Index>(cells_) + 1, 0, 1);
    return VectorXd::Map(positions_.data(), static_cast<Index>(positions_.size()));
  }

  /// Where the scatterers and what arrives at them are asked for.
  VectorXd scatterers() const {
    const VectorXd ends = crossings();
    if (cells_ > 0) return 0.5 * (ends.head(ends.size() - 1) + ends.tail(ends.size() - 1));
    return ends;
  }

 private:
  const Options& options_;
  KineticProblem problem_;
  double cells_ = 0;  // 0: continuum
  std::vector<double> positions_{0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1};
};

/// Values of the quantities, in the order of descriptions().
using Values = std::vector<std::vector<double>>;

struct Grid {
  VectorXd crossings, scatterers;
  Bins bins;
  double root_mass;  // P / U

  VectorXd middles() const {  // of the bins p > 0
    const std::vector<double> all = bins.middles();
    return VectorXd::Map(all.data(), static_cast<Index>(all.size())).tail(static_cast<Index>(all.size() / 2));
  }
  VectorXd edges() const {  // of the bins p > 0
    const auto half = static_cast<Index>(bins.count() / 2);
    return VectorXd::LinSpaced(half + 1, 0, bins.edge(bins.count()));
  }
};

std::vector<double> list(const MatrixXd& matrix) { return {matrix.data(), matrix.data() + matrix.size()}; }

/// Columns of values at p > 0 over values at p < 0, in ascending order of p.
MatrixXd ascending(const MatrixXd& right, const MatrixXd& left) {
  MatrixXd result(right.rows() + left.rows(), right.cols());
  result << left.colwise().reverse(), right;
  return result;
}

MatrixXd on_half_lines(const MatrixXd& matrix, const Flux& flux) {
  return ascending(matrix * flux.topRows(matrix.cols()), matrix * flux.bottomRows(matrix.cols()));
}

/// Largest deviation of the currents over x.
double spread(const KineticProblem& problem, const Currents& currents) {
  const auto scale = injected(problem.left, problem.right);
  double largest = 0;
  for (Index i = 0; i < currents.particles.size(); ++i)
    for (std::size_t n = 0; n < scale.size(); ++n)
      largest = std::max(largest, std::abs(currents.values(i)[n] - currents.values(0)[n]) / scale[n]);
  return largest;
}

Values evaluate(const KineticProblem& problem, const KineticSolution& solution, const Grid& grid) {
  const Panels& momenta = solution.momenta();
  const Flux flux = solution.flux(grid.crossings), arriving = solution.flux(grid.scatterers);
  const HalfMoments moments(momenta, flux), arrivals(momenta, arriving);
  const Currents currents(moments);

  const MatrixXd integrals = momenta.integration(grid.edges());
  const Index bins = integrals.rows() - 1;
  const MatrixXd means = (integrals.bottomRows(bins) - integrals.topRows(bins)) / grid.bins.width();
  const MatrixXd density = solution.scatterer_density(grid.scatterers, grid.middles()) / grid.root_mass;

  const RowVectorXd temperature = arrivals.whole(2).array() / arrivals.whole(0).array();
  const RowVectorXd mean = arrivals.whole(1).array() / arrivals.whole(0).array();
  // U = sum_j c sigma^j v_j: <U> = <p> P/U, and the variance is that of v.
  const double push = grid.root_mass * grid.root_mass - 1;
  const RowVectorXd scatterer_temperature = temperature.array() + push * mean.array().square();

  const RowVectorXd right = moments.right(0), left = moments.left(0);
  const RowVectorXd jump = momenta.interpolation(VectorXd::Zero(1)) *
                           (flux.topRows(momenta.size()) - flux.bottomRows(momenta.size()));
  MatrixXd kurtosis(2, flux.cols());
  kurtosis.row(0) = moments.left(4).array() * left.array() / moments.left(2).array().square();
  kurtosis.row(1) = moments.right(4).array() * right.array() / moments.right(2).array().square();
  // Beyond the range of numbers there is none.
  kurtosis = kurtosis.array().isFinite().select(kurtosis, std::numeric_limits<double>::quiet_NaN());
  return {list(on_half_lines(means, flux)),
          list(on_half_lines(momenta.interpolation(grid.middles()), flux)),
          list(ascending(density.topRows(bins), density.bottomRows(bins))),
          {currents.particles.mean()},
          {currents.energy.mean()},
          {currents.momentum.mean()},
          {spread(problem, currents)},
          list(scatterer_temperature),
          list(temperature),
          list(right),
          list(left),
          list(jump),
          list(kurtosis)};
}

std::vector<Description> descriptions(const Grid& grid) {
  const auto values = [](const VectorXd& x) { return std::vector<double>(x.begin(), x.end()); };
  const Axis x{"x", "1", "Position over the length of the chain; bonds of a chain of cells",
               values(grid.crossings)};
  const Axis site{"x", "1", "Position over the length of the chain; scatterers of a chain of cells",
                  values(grid.scatterers)};
  const Axis momentum{"momentum", "momentum", "Middle of the bin", grid.bins.middles()};
  Axis scatterer_momentum{"momentum", "momentum", "P, the particle's times sqrt(M)", momentum.values};
  for (double& value : scatterer_momentum.values) value *= grid.root_mass;
  const Axis half{"half", "1", "Sign of p", {-1, 1}};
  return {{"flux", "1/(time momentum)", "F(p, x), mean over a bin of p", {x, momentum}},
          {"flux_density", "1/(time momentum)", "F(p, x)", {x, momentum}},
          {"scatterer_density", "1/momentum", "g(P, x), probability density", {site, scatterer_momentum}},
          {"particle_current", "1/time", "Particles to the right minus to the left"},
          {"energy_current", "energy/time", "Energy to the right minus to the left"},
          {"momentum_flux", "momentum/time", "Integral of |p| F: pressure"},
          {"current_spread", "1", "Largest deviation of a current over x, relative to what the baths inject"},
          {"temperature_scatterer", "temperature", "<P^2>/M", {site}},
          {"temperature_particle", "temperature", "<p^2> over the arrivals at a scatterer", {site}},
          {"rate_right", "1/time", "Crossings to the right", {x}},
          {"rate_left", "1/time", "Crossings to the left", {x}},
          {"jump", "1/(time momentum)", "F at p = 0+ minus p = 0-", {x}},
          {"kurtosis", "1", "<p^4>/<p^2>^2 by direction; 3 for a Gaussian half", {x, half}}};
}

/// Currents are as small as they like; what they are rounded to depends on what is injected.
double largest_value(const KineticProblem& problem, const std::string& name,
                     const std::vector<double>& values) {
  const auto [particles, energy, momentum] = injected(problem.left, problem.right);
  if (name == "particle_current") return particles;
  if (name == "energy_current") return energy;
  double largest = 0;
  for (const double value : values)
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  return largest;
}

/// Largest difference over all places and momenta: at some of them the two agree by chance.
double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::isfinite(a[i])) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

Results results(const KineticProblem& problem, const RefinedSolution& solution, const Grid& grid) {
  const Values fine = evaluate(problem, *solution.fine, grid);
  const Values coarse = evaluate(problem, *solution.coarse, grid);
  Results results;
  for (const Description& what : descriptions(grid)) {
    const std::vector<double>& values = fine[results.size()];
    const double error = largest_difference(values, coarse[results.size()]) +
                         rounding * largest_value(problem, what.name, values);
    std::vector<double> errors(values.size(), error);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!std::isfinite(values[i])) errors[i] = std::numeric_limits<double>::quiet_NaN();
    results.push_back({what, values, errors, {}});
  }
  results.push_back({{"momentum_points", "1", "Points in momentum, both halves together"},
                     {static_cast<double>(2 * solution.fine->momenta().size())},
                     {std::numeric_limits<double>::quiet_NaN()},
                     {}});
  return results;
}

}  // namespace

int main(int argc, char** argv) {
  Program program("boltzmann", "Kinetic equation of the open chain, solved to a given accuracy");
  ProblemOptions options(program.options());
  options.declare(program.options());
  MomentumBinsOptions bins(100, 60);
  bins.declare(program.options());
  double target = 1e-10;
  program.options().real("--target-error", target, non_negative,
                         "Relative error of the currents at which the resolution suffices");
  std::uint32_t coarsening = 0;
  program.options().integer("--coarsening", coarsening, {0, 4},
                            "Levels below the usual one at which the refinement begins");
  return program.run(argc, argv, [&](Progress& progress) {
    options.validate();
    bins.validate();
    const KineticProblem problem = options.problem();
    const RefinedSolution solution = refine(problem, target, static_cast<int>(coarsening), [] {
      if (const int signal = received_signal(); signal != 0) throw Interrupted(signal);
    });
    const Convergence convergence =
        solution.error <= target ? Convergence::reached : Convergence::not_reached;
    if (convergence == Convergence::not_reached)
      progress.say(fmt::format("target not reached: the currents are known to {:.1e}, not to {:.1e}",
                               solution.error, target));
    const Grid grid{options.crossings(), options.scatterers(), bins.bins(),
                    std::sqrt((1 + problem.sigma) / (1 - problem.sigma))};
    return Outcome{.results = results(problem, solution, grid),
                   .streams = "none",
                   .events = static_cast<std::uint64_t>(solution.evaluations),
                   .target_quantity = "currents",
                   .target_error = target,
                   .achieved_error = solution.error,
                   .convergence = convergence};
  });
}
