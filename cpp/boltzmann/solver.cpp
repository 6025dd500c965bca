#include "boltzmann/solver.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>

#include "boltzmann/gmres.hpp"
#include "boltzmann/hydrodynamic_preconditioner.hpp"

namespace lorentz {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double reach = 12;        // of the momenta, in thermal momenta: exp(-72) is left beyond
constexpr double finest = 0.25;     // smallest panel of momenta, in units of the smoothing of F near 0
constexpr double slowest = 1;       // smallest panel of wave numbers, in units of 1 / thermal momentum
constexpr double undetected = 1e-17;  // G^ is cut off where it has fallen to this part of its maximum

struct Widths {
  double narrow, wide;  // thermal momenta
};

Widths thermal_momenta(const KineticProblem& problem) {
  const double left = std::sqrt(problem.left.temperature), right = std::sqrt(problem.right.temperature);
  if (problem.left.rate == 0) return {right, right};
  if (problem.right.rate == 0) return {left, left};
  return {std::min(left, right), std::max(left, right)};
}

/// G is F smoothed near p = 0 over this part of the thermal momentum.
double smoothing(double sigma) {
  return std::min(std::abs(sigma), std::sqrt((1 - sigma) * (1 + sigma)));
}

Panels momentum_panels(const KineticProblem& problem, int order) {
  const Widths width = thermal_momenta(problem);
  const double layer = problem.sigma == 0 ? 1 : smoothing(problem.sigma);
  return {graded_breaks(finest * layer * width.narrow, reach * width.wide, 2), order};
}

/// Bound of |G^(k)| / J for a flux that jumps at 0: |phi(k)| < 1/(k width).
double decay(double sigma, double k) {
  double product = std::min(1.0, 1 / (std::abs(sigma) * k));
  for (double scale = (1 - sigma) * (1 + sigma); scale * k > 1 && product > undetected; scale *= std::abs(sigma))
    product /= scale * k;
  return product;
}

Panels wave_number_panels(const KineticProblem& problem, int order) {
  const Widths width = thermal_momenta(problem);
  double cutoff = 8;
  while (problem.sigma != 0 && decay(problem.sigma, cutoff) > undetected) cutoff *= 1.25;
  return {graded_breaks(slowest / width.wide, cutoff / width.narrow, 2), order};
}

Sites make_sites(const KineticProblem& problem, const Resolution& resolution) {
  return problem.cells > 0 ? Sites::chain(problem.cells) : Sites::continuum(resolution.sites);
}

VectorXd injected(const Reservoir& bath, const VectorXd& p) {
  const double height = bath.rate * std::sqrt(2 / (std::numbers::pi * bath.temperature));
  return height * (-p.array().square() / (2 * bath.temperature)).exp();
}

/// (1 + gamma B)^-1 gamma B.
MatrixXd absorbing(double gamma, const MatrixXd& b) {
  return (MatrixXd::Identity(b.rows(), b.cols()) + gamma * b).partialPivLu().solve(gamma * b);
}

}  // namespace

KineticSolution::KineticSolution(const KineticProblem& problem, const Resolution& resolution)
    : problem_(problem),
      momenta_(momentum_panels(problem, resolution.order)),
      sites_(make_sites(problem, resolution)),
      collision_(problem.sigma, momenta_, wave_number_panels(problem, resolution.order)),
      left_(injected(problem.left, momenta_.nodes())),
      right_(injected(problem.right, momenta_.nodes())) {
  // Between baths that scatter without changing momenta: exact at sigma = -1.
  const Eigen::RowVectorXd x = problem.gamma * sites_.positions().transpose();
  const Eigen::RowVectorXd near = ((1 + problem.gamma) - x.array()) / (1 + problem.gamma);
  const Index half = momenta_.size();
  flux_.resize(2 * half, x.size());
  flux_.topRows(half) = left_ * near + right_ * (1 - near.array()).matrix();
  flux_.bottomRows(half) = right_ * near.reverse() + left_ * (1 - near.reverse().array()).matrix();
}

Flux KineticSolution::arriving(const Transport& transport, const Flux& source) const {
  const Index half = momenta_.size();
  Flux flux(2 * half, transport.from_left.rows());
  flux.topRows(half) = (source.topRows(half) * transport.from_left.transpose()).colwise() + left_;
  flux.bottomRows(half) = (source.bottomRows(half) * transport.from_right.transpose()).colwise() + right_;
  return flux;
}

Flux KineticSolution::flux(const VectorXd& x) const { return arriving(sites_.transport_to(x), source_); }

double KineticSolution::size(const Flux& residual) const {
  const Index half = momenta_.size();
  const Eigen::RowVectorXd at =
      momenta_.weights().transpose() *
      (residual.topRows(half).cwiseAbs() + residual.bottomRows(half).cwiseAbs());
  return at.maxCoeff() / (problem_.left.rate + problem_.right.rate);
}

void KineticSolution::start_from(const KineticSolution& other) {
  const Flux flux = other.flux(sites_.positions());
  const MatrixXd values = other.momenta_.interpolation(momenta_.nodes());
  flux_ << values * flux.topRows(values.cols()), values * flux.bottomRows(values.cols());
}

void KineticSolution::solve() {
  constexpr int newton_limit = 30, krylov_limit = 200;
  const Transport transport = sites_.transport_to(sites_.positions());
  const Streaming streaming{absorbing(problem_.gamma, transport.from_left),
                            absorbing(problem_.gamma, transport.from_right)};
  const Flux nothing = Flux::Zero(flux_.rows(), flux_.cols());
  const auto as_vector = [](const Flux& flux) -> VectorXd { return flux.reshaped(); };
  const auto as_flux = [&](const VectorXd& vector) -> Flux {
    return vector.reshaped(flux_.rows(), flux_.cols());
  };
  for (int step = 0; step < newton_limit; ++step) {
    source_ = problem_.gamma * (collision_.gain(flux_) - flux_);
    ++evaluations_;
    const Flux residual = arriving(transport, source_) - flux_;
    const double now = size(residual);
    std::cerr << step << " " << now << " " << evaluations_ << "\n";
    if (now < 3e-14) return;
    const Index half = momenta_.size();
    const Eigen::RowVectorXd number = momenta_.weights().transpose() * (flux_.topRows(half) + flux_.bottomRows(half));
    const Eigen::RowVectorXd temperatures = (momenta_.weights().array() * momenta_.nodes().array().square()).matrix().transpose() *
                 (flux_.topRows(half) + flux_.bottomRows(half)) * number.cwiseInverse().asDiagonal();
    const HydrodynamicPreconditioner preconditioner(problem_.sigma, momenta_, streaming, temperatures);
    const KrylovResult change = gmres(
        [&](const VectorXd& v) {
          ++evaluations_;
          const Flux f = as_flux(v);
          return as_vector(f - streaming(collision_.derivative(f)));
        },
        [&](const VectorXd& v) { return as_vector(preconditioner(as_flux(v))); },
        as_vector(residual - streaming(residual)), 1e-6, krylov_limit);
    flux_ += as_flux(change.solution);
  }
  throw ConvergenceError("no convergence");
}

}  // namespace lorentz
