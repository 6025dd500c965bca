#include "boltzmann/solver.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "boltzmann/gmres.hpp"

namespace lorentz {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double reach = 11;     // largest momentum in thermal momenta; F falls to exp(-60) of its maximum
constexpr double finest = 0.25;  // smallest panel of momenta in units of smoothing()
constexpr double slowest = 1;    // smallest panel of wave numbers in units of 1 / thermal momentum
constexpr double undetected = 1e-16;  // part of its maximum at which g^ is truncated
constexpr double exchange = 1e-8;     // |sigma| below which sigma = 0 is solved: G - F is of order sigma^2

struct Widths {
  double narrow, wide;  // thermal momenta of the colder and the hotter bath
};

Widths thermal_momenta(const KineticProblem& problem) {
  const double left = std::sqrt(problem.left.temperature), right = std::sqrt(problem.right.temperature);
  if (problem.left.rate == 0) return {right, right};
  if (problem.right.rate == 0) return {left, left};
  return {std::min(left, right), std::max(left, right)};
}

/// Width in thermal momenta over which G is smooth near p = 0, where F is discontinuous.
double smoothing(double sigma) { return std::min(std::abs(sigma), std::sqrt((1 - sigma) * (1 + sigma))); }

KineticProblem with_exchange(KineticProblem problem) {
  if (std::abs(problem.sigma) < exchange) problem.sigma = 0;
  return problem;
}

Panels momentum_panels(const KineticProblem& problem, int order) {
  const Widths width = thermal_momenta(problem);
  const double layer = problem.sigma == 0 ? 1 : smoothing(problem.sigma);
  return {graded_breaks(finest * layer * width.narrow, reach * width.wide, 2), order};
}

/// Bound of |q(k)| for a flux that is discontinuous at 0, from |phi(k)| < 1/(k width).
double decay(double sigma, double k) {
  double product = 1;
  for (double scale = (1 - sigma) * (1 + sigma); scale * k > 1 && product > undetected;
       scale *= std::abs(sigma))
    product /= scale * k;
  return product;
}

Panels wave_number_panels(const KineticProblem& problem, int order) {
  const Widths width = thermal_momenta(problem);
  double cutoff = 8;
  while (problem.sigma != 0 && decay(problem.sigma, cutoff) > undetected) cutoff *= 1.25;
  return {graded_breaks(slowest / width.wide, cutoff / width.narrow, 1.4), order};
}

Sites make_sites(const KineticProblem& problem, const Resolution& resolution) {
  return problem.cells > 0 ? Sites::chain(problem.cells) : Sites::continuum(resolution.sites);
}

/// Free streaming with absorption at the sites: L = (1 + gamma B)^-1 gamma B with B = from_left or from_right
/// maps the gain at the sites to the flux that arrives there, the same for every |p|.
class Streaming {
 public:
  Streaming(double gamma, const Transport& transport)
      : to_right_(response(gamma, transport.from_left)), to_left_(response(gamma, transport.from_right)) {}

  Flux operator()(const Flux& gain) const {
    const Index half = gain.rows() / 2;
    Flux flux(gain.rows(), gain.cols());
    flux.topRows(half) = gain.topRows(half) * to_right_.transpose();
    flux.bottomRows(half) = gain.bottomRows(half) * to_left_.transpose();
    return flux;
  }

 private:
  static MatrixXd response(double gamma, const MatrixXd& b) {
    return (MatrixXd::Identity(b.rows(), b.rows()) + gamma * b).partialPivLu().solve(gamma * b);
  }

  MatrixXd to_right_, to_left_;
};

/// Bath with the mean rate and the rate-weighted mean temperature; equal to both baths to the last digit if
/// they are equal.
Reservoir mean(const Reservoir& left, const Reservoir& right) {
  const double weight = right.rate / (left.rate + right.rate);
  return {0.5 * (left.rate + right.rate), left.temperature + weight * (right.temperature - left.temperature)};
}

}  // namespace

Resolution Resolution::level(int level, double gamma) {
  const double factor = std::pow(std::numbers::sqrt2, level);
  const double layers = std::sqrt(gamma);  // sqrt(gamma) Gauss nodes resolve boundary layers of width 1/gamma
  return {static_cast<int>(std::lround(14 * factor)), static_cast<int>(std::ceil((5 + 3 * layers) * factor))};
}

KineticSolution::KineticSolution(const KineticProblem& problem, const Resolution& resolution,
                                 const KineticSolution* guess)
    : problem_(with_exchange(problem)),
      equilibrium_(mean(problem.left, problem.right)),
      momenta_(momentum_panels(problem_, resolution.order)),
      sites_(make_sites(problem_, resolution)),
      collision_(problem_.sigma, equilibrium_, momenta_, wave_number_panels(problem_, resolution.order)),
      left_(injected_flux(problem.left, momenta_.nodes()) - injected_flux(equilibrium_, momenta_.nodes())),
      right_(injected_flux(problem.right, momenta_.nodes()) - injected_flux(equilibrium_, momenta_.nodes())) {
  iterate(guess != nullptr ? resampled(*guess) : first_guess());
}

/// Solution for scattering that reverses every momentum, G(p) = F(-p).
Flux KineticSolution::first_guess() const {
  const Eigen::RowVectorXd x = problem_.gamma * sites_.positions().transpose();
  const Eigen::RowVectorXd near = ((1 + problem_.gamma) - x.array()) / (1 + problem_.gamma);
  const Eigen::RowVectorXd far = 1 - near.array(), near_right = near.reverse(), far_right = far.reverse();
  Flux flux(2 * momenta_.size(), x.size());
  flux << left_ * near + right_ * far, right_ * near_right + left_ * far_right;
  return flux;
}

Flux KineticSolution::resampled(const KineticSolution& other) const {
  const Flux coarse = other.deviation(sites_.positions());
  const MatrixXd values = other.momenta_.interpolation(momenta_.nodes());
  Flux flux(2 * momenta_.size(), coarse.cols());
  flux << values * coarse.topRows(values.cols()), values * coarse.bottomRows(values.cols());
  return flux;
}

Flux KineticSolution::arriving(const Transport& transport, const Flux& source) const {
  const Index half = momenta_.size();
  Flux flux(2 * half, transport.from_left.rows());
  flux.topRows(half) = (source.topRows(half) * transport.from_left.transpose()).colwise() + left_;
  flux.bottomRows(half) = (source.bottomRows(half) * transport.from_right.transpose()).colwise() + right_;
  return flux;
}

Flux KineticSolution::deviation(const VectorXd& x) const { return arriving(sites_.transport_to(x), source_); }

Flux KineticSolution::flux(const VectorXd& x) const {
  return deviation(x).colwise() + injected_flux(equilibrium_, momenta_.nodes()).replicate(2, 1).col(0);
}

double KineticSolution::size(const Flux& residual) const {
  const Index half = momenta_.size();
  const Eigen::RowVectorXd at = momenta_.weights().transpose() *
                                (residual.topRows(half).cwiseAbs() + residual.bottomRows(half).cwiseAbs());
  return at.maxCoeff() / (problem_.left.rate + problem_.right.rate);
}

Flux KineticSolution::scatterer_density(const VectorXd& x, const VectorXd& points) const {
  CollisionOperator collision = collision_;
  collision.gain(deviation(x));
  return collision.scatterer_density(points);
}

void KineticSolution::iterate(Flux flux) {
  constexpr int newton_limit = 100, krylov_limit = 200;
  constexpr double rounding = 3e-14;    // relative residual that rounding permits
  constexpr double acceptable = 1e-10;  // relative residual that suffices if it falls no further
  const Transport transport = sites_.transport_to(sites_.positions());
  const Streaming streaming(problem_.gamma, transport);
  const auto as_flux = [&](const VectorXd& vector) -> Flux {
    return vector.reshaped(flux.rows(), flux.cols());
  };
  const auto count = [&] { ++evaluations_; };
  const LinearMap linearised = [&](const VectorXd& vector) -> VectorXd {
    count();
    const Flux direction = as_flux(vector);
    return (direction - streaming(collision_.derivative(direction))).reshaped();
  };
  Flux change = Flux::Zero(flux.rows(), flux.cols());
  double smallest = std::numeric_limits<double>::infinity();
  for (int step = 0; step < newton_limit; ++step) {
    count();
    source_ = problem_.gamma * (collision_.gain(flux) - flux);
    const Flux missing = arriving(transport, source_) - flux;
    const Flux residual = missing - streaming(missing);
    const double now = size(residual);
    const bool stagnates = smallest < acceptable && now > 0.5 * smallest;
    if (now < rounding || (stagnates && now < acceptable)) return;
    if (!(now < smallest)) {  // the step was too long, or gave NaN
      change *= 0.5;
      flux -= change;
      continue;
    }
    smallest = now;
    // A tolerance proportional to the residual keeps Newton's convergence quadratic; its lower bound is the
    // accuracy that rounding permits.
    const double tolerance = std::min(0.01, std::max(now, 0.1 * rounding / now));
    change = as_flux(gmres(linearised, residual.reshaped(), tolerance, krylov_limit).solution);
    flux += change;
  }
  throw ConvergenceError(
      "Newton's iteration for the Boltzmann equation did not converge. Choose baths that differ less, a "
      "smaller gamma, or sigma farther from -1, 0 and 1.");
}

}  // namespace lorentz
