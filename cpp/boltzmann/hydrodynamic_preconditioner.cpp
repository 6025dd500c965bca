#include "boltzmann/hydrodynamic_preconditioner.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lorentz {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double fast = 0.5;         // modes with smaller eigenvalues are left to the iteration
constexpr Index largest_system = 2000;  // unknowns: a second of work

double eigenvalue(double sigma, int n) {
  if (n == 0) return 1;
  return std::pow(-sigma, n) + std::pow((1 - sigma) * (1 + sigma), n) / (1 - std::pow(sigma, n));
}

Index slow_modes(double sigma, Index sites) {
  const Index most = std::clamp<Index>(largest_system / sites, 3, 40);
  Index count = 3;
  for (Index n = count; n < most; ++n)
    if (eigenvalue(sigma, static_cast<int>(n)) > fast) count = n + 1;
  return count;
}

double sign(Index n) { return n % 2 == 0 ? 1 : -1; }

}  // namespace

Flux Streaming::operator()(const Flux& gain) const {
  const Index half = gain.rows() / 2;
  Flux flux(gain.rows(), gain.cols());
  flux.topRows(half).noalias() = gain.topRows(half) * right.transpose();
  flux.bottomRows(half).noalias() = gain.bottomRows(half) * left.transpose();
  return flux;
}

HydrodynamicPreconditioner::HydrodynamicPreconditioner(double sigma, const Panels& momenta,
                                                       const Streaming& streaming,
                                                       const Eigen::RowVectorXd& temperatures)
    : streaming_(streaming), count_(slow_modes(sigma, temperatures.size())) {
  const Index sites = temperatures.size(), size = count_ * sites;
  tests_.resize(momenta.size(), size);
  shapes_.resize(momenta.size(), size);
  for (Index site = 0; site < sites; ++site) {
    const double scale = std::sqrt(temperatures[site]);
    const Eigen::ArrayXd z = momenta.nodes().array() / scale;
    const Eigen::ArrayXd maxwellian = (-0.5 * z.square()).exp() / (scale * std::sqrt(2 * std::numbers::pi));
    Eigen::ArrayXd before = Eigen::ArrayXd::Zero(z.size()), hermite = Eigen::ArrayXd::Ones(z.size());
    for (Index n = 0; n < count_; ++n) {  // orthonormal: He_n / sqrt(n!)
      const Index column = site * count_ + n;
      tests_.col(column) = hermite * momenta.weights().array();
      shapes_.col(column) = eigenvalue(sigma, static_cast<int>(n)) * hermite * maxwellian;
      const auto order = static_cast<double>(n);
      const Eigen::ArrayXd next = (z * hermite - std::sqrt(order) * before) / std::sqrt(order + 1);
      before = hermite;
      hermite = next;
    }
  }
  MatrixXd system = tests_.transpose() * shapes_;  // overlaps on p > 0; those on p < 0 differ by signs
  for (Index column = 0; column < size; ++column)
    for (Index row = 0; row < size; ++row) {
      const Index to = row / count_, from = column / count_;
      system(row, column) *= -(streaming_.right(to, from) + sign(row % count_ + column % count_) * streaming_.left(to, from));
    }
  system.diagonal().array() += 1;
  factors_.compute(system);
}

VectorXd HydrodynamicPreconditioner::moments(const Flux& flux) const {
  const Index half = flux.rows() / 2;
  VectorXd result(tests_.cols());
  for (Index column = 0; column < tests_.cols(); ++column) {
    const auto at = flux.col(column / count_);
    result[column] = tests_.col(column).dot(at.head(half) + sign(column % count_) * at.tail(half));
  }
  return result;
}

Flux HydrodynamicPreconditioner::modes(const VectorXd& amplitudes) const {
  const Index half = shapes_.rows();
  Flux result = Flux::Zero(2 * half, shapes_.cols() / count_);
  for (Index column = 0; column < shapes_.cols(); ++column) {
    auto at = result.col(column / count_);
    at.head(half) += amplitudes[column] * shapes_.col(column);
    at.tail(half) += sign(column % count_) * amplitudes[column] * shapes_.col(column);
  }
  return result;
}

Flux HydrodynamicPreconditioner::operator()(const Flux& residual) const {
  return residual + streaming_(modes(factors_.solve(moments(residual))));
}

}  // namespace lorentz
