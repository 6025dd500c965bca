#include "boltzmann/hydrodynamic_preconditioner.hpp"

#include <algorithm>
#include <cmath>

namespace lorentz {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Hermite modes at a site: the three conserved ones and three more. He_n grows as p^n, so the errors of the
/// tails dominate moments of much higher order.
constexpr Index modes_at_site = 6;  // even

/// Eigenvalue epsilon_n of the linearised gain [eq. 42].
double eigenvalue(double sigma, Index order) {
  const auto n = static_cast<int>(order);
  if (n == 0) return 1;
  return std::pow(-sigma, n) + std::pow((1 - sigma) * (1 + sigma), n) / (1 - std::pow(sigma, n));
}

double sign(Index n) { return n % 2 == 0 ? 1 : -1; }

}  // namespace

Streaming Streaming::absorbing(double gamma, const MatrixXd& from_left, const MatrixXd& from_right) {
  const Index sites = from_left.rows();
  const auto response = [&](const MatrixXd& b) -> MatrixXd {
    return (MatrixXd::Identity(sites, sites) + gamma * b).partialPivLu().solve(gamma * b);
  };
  Streaming result{MatrixXd::Zero(2 * sites, 2 * sites)};
  result.matrix.topLeftCorner(sites, sites) = response(from_left);
  result.matrix.bottomRightCorner(sites, sites) = response(from_right);
  return result;
}

Flux Streaming::operator()(const Flux& gain) const {
  const Index half = gain.rows() / 2, sites = gain.cols();
  Flux stacked(half, 2 * sites), flux(gain.rows(), sites);
  stacked << gain.topRows(half), gain.bottomRows(half);
  const Flux result = stacked * matrix.transpose();
  flux << result.leftCols(sites), result.rightCols(sites);
  return flux;
}

HydrodynamicPreconditioner::HydrodynamicPreconditioner(double sigma, const Panels& momenta,
                                                       const Streaming& streaming,
                                                       const Eigen::RowVectorXd& temperatures)
    : even_(eigenvalue(sigma, modes_at_site)), odd_(eigenvalue(sigma, modes_at_site + 1)) {
  static_assert(modes_at_site % 2 == 0);
  const Index sites = temperatures.size(), size = modes_at_site * sites;
  // (even + odd)/2 couples p to itself, (even - odd)/2 couples p to -p.
  const MatrixXd identity = MatrixXd::Identity(sites, sites);
  MatrixXd shared(2 * sites, 2 * sites);
  shared << 0.5 * (even_ + odd_) * identity, 0.5 * (even_ - odd_) * identity, 0.5 * (even_ - odd_) * identity,
      0.5 * (even_ + odd_) * identity;
  response_.matrix = (MatrixXd::Identity(2 * sites, 2 * sites) - streaming.matrix * shared)
                         .partialPivLu()
                         .solve(streaming.matrix);
  tests_.resize(momenta.size(), size);
  shapes_.resize(momenta.size(), size);
  for (Index site = 0; site < sites; ++site) {
    const double scale = std::sqrt(temperatures[site]);
    const Eigen::ArrayXd z = momenta.nodes().array() / scale;
    const Eigen::ArrayXd maxwellian = normal_density(z, scale);
    Eigen::ArrayXd before = Eigen::ArrayXd::Zero(z.size()), hermite = Eigen::ArrayXd::Ones(z.size());
    for (Index n = 0; n < modes_at_site; ++n) {  // orthonormal: He_n / sqrt(n!)
      const Index column = site * modes_at_site + n;
      tests_.col(column) = hermite * momenta.weights().array();
      shapes_.col(column) = (eigenvalue(sigma, n) - (n % 2 == 0 ? even_ : odd_)) * hermite * maxwellian;
      const auto order = static_cast<double>(n);
      const Eigen::ArrayXd next = (z * hermite - std::sqrt(order) * before) / std::sqrt(order + 1);
      before = hermite;
      hermite = next;
    }
  }
  MatrixXd system = tests_.transpose() * shapes_;  // overlaps on p > 0; those on p < 0 differ in sign only
  const auto& r = response_.matrix;
  for (Index column = 0; column < size; ++column)
    for (Index row = 0; row < size; ++row) {
      const Index to = row / modes_at_site, from = column / modes_at_site;
      const double test = sign(row % modes_at_site), shape = sign(column % modes_at_site);
      system(row, column) *= -(r(to, from) + shape * r(to, sites + from) + test * r(sites + to, from) +
                               test * shape * r(sites + to, sites + from));
    }
  system.diagonal().array() += 1;
  factors_.compute(system);
}

VectorXd HydrodynamicPreconditioner::moments(const Flux& flux) const {
  const Index half = flux.rows() / 2;
  VectorXd result(tests_.cols());
  for (Index column = 0; column < tests_.cols(); ++column) {
    const auto at = flux.col(column / modes_at_site);
    result[column] = tests_.col(column).dot(at.head(half) + sign(column % modes_at_site) * at.tail(half));
  }
  return result;
}

Flux HydrodynamicPreconditioner::modes(const VectorXd& amplitudes) const {
  const Index half = shapes_.rows();
  Flux result = Flux::Zero(2 * half, shapes_.cols() / modes_at_site);
  for (Index column = 0; column < shapes_.cols(); ++column) {
    auto at = result.col(column / modes_at_site);
    at.head(half) += amplitudes[column] * shapes_.col(column);
    at.tail(half) += sign(column % modes_at_site) * amplitudes[column] * shapes_.col(column);
  }
  return result;
}

/// Product with G' if every mode had its shared eigenvalue.
Flux HydrodynamicPreconditioner::common(const Flux& flux) const {
  const Index half = flux.rows() / 2;
  Flux result = 0.5 * (even_ + odd_) * flux;
  result.topRows(half) += 0.5 * (even_ - odd_) * flux.bottomRows(half);
  result.bottomRows(half) += 0.5 * (even_ - odd_) * flux.topRows(half);
  return result;
}

Flux HydrodynamicPreconditioner::operator()(const Flux& residual) const {
  const Flux first = residual + response_(common(residual));
  return first + response_(modes(factors_.solve(moments(first))));
}

}  // namespace lorentz
