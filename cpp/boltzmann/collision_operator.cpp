#include "boltzmann/collision_operator.hpp"

#include <cmath>
#include <numbers>

namespace lorentz {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;
using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr double last_scale = 1e-17;  // sigma^j of the last factor of the product

double c_squared(double sigma) { return (1 - sigma) * (1 + sigma); }

/// Number of factors of the product, as a power of two.
int doublings(double sigma) {
  const double factors = std::log(last_scale) / std::log(std::abs(sigma));
  return std::max(1, static_cast<int>(std::ceil(std::log2(factors))));
}

/// Takes the values of a function that vanishes at 0 to its values at `scale` times the nodes: what is
/// interpolated is the function divided by k, so that an error near 0 does not add up over many factors.
Eigen::SparseMatrix<double, Eigen::RowMajor> scaling(const Panels& panels, double scale) {
  Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(panels.size(), panels.size());
  matrix.reserve(Eigen::VectorXi::Constant(panels.size(), panels.order()));
  for (Index row = 0; row < panels.size(); ++row) {
    const double point = scale * panels.nodes()[row];
    const std::size_t panel = panels.panel(point);
    const VectorXd weights = panels.lagrange(panel, point);
    for (Index i = 0; i < weights.size(); ++i) {
      const Index node = static_cast<Index>(panel) * panels.order() + i;
      matrix.insert(row, node) = weights[i] * point / panels.nodes()[node];
    }
  }
  matrix.makeCompressed();
  return matrix;
}

}  // namespace

CollisionOperator::CollisionOperator(double sigma, const Panels& momenta, const Panels& wave_numbers)
    : sigma_(sigma), momenta_(momenta), wave_numbers_(wave_numbers) {
  if (sigma == 0) return;  // momenta are exchanged: G = F and J g = F
  reflected_ = momenta.fourier(std::abs(sigma) * wave_numbers.nodes());
  kicked_ = momenta.fourier(c_squared(sigma) * wave_numbers.nodes());
  kicked_.cosine = kicked_.cosine_minus_one;
  inverse_ = wave_numbers.fourier(momenta.nodes());
  for (int n = 0; n < doublings(sigma); ++n)
    scalings_.push_back(scaling(wave_numbers, std::pow(std::abs(sigma), std::ldexp(1, n))));
}

RowVectorXd CollisionOperator::number(const Flux& flux) const {
  const Index half = momenta_.size();
  return momenta_.weights().transpose() * (flux.topRows(half) + flux.bottomRows(half));
}

CollisionOperator::Spectrum CollisionOperator::transform(const FourierIntegrals& integrals,
                                                         const Flux& flux) const {
  const Index half = momenta_.size();
  Spectrum spectrum(integrals.cosine.rows(), flux.cols());
  spectrum.real() = integrals.cosine * (flux.topRows(half) + flux.bottomRows(half));
  spectrum.imag() = integrals.sine * (flux.topRows(half) - flux.bottomRows(half));
  return spectrum;
}

Flux CollisionOperator::inverse_transform(const FourierIntegrals& integrals, const Spectrum& spectrum) const {
  const MatrixXd even = integrals.cosine * spectrum.real() / std::numbers::pi;
  const MatrixXd odd = integrals.sine * spectrum.imag() / std::numbers::pi;
  Flux flux(2 * even.rows(), even.cols());
  flux << even + odd, even - odd;
  return flux;
}

/// The spectrum at sigma^(2^doubling) k; only the first of these factors can be negative.
CollisionOperator::Spectrum CollisionOperator::scaled(std::size_t doubling, const Spectrum& spectrum) const {
  Spectrum result(spectrum.rows(), spectrum.cols());
  const Eigen::Map<const RowMajorMatrix> from(reinterpret_cast<const double*>(spectrum.data()),
                                              spectrum.rows(), 2 * spectrum.cols());
  Eigen::Map<RowMajorMatrix> to(reinterpret_cast<double*>(result.data()), result.rows(), 2 * result.cols());
  to.noalias() = scalings_[doubling] * from;
  if (doubling == 0 && sigma_ < 0) result = result.conjugate().eval();
  return result;
}

Flux CollisionOperator::gain(const Flux& flux) {
  flux_ = flux;
  number_ = number(flux);
  const Index half = momenta_.size();
  temperature_ = (momenta_.weights().array() * momenta_.nodes().array().square()).matrix().transpose() *
                 (flux.topRows(half) + flux.bottomRows(half)) * number_.cwiseInverse().asDiagonal();
  if (sigma_ == 0) return flux;
  reflected_flux_ = transform(reflected_, flux);
  if (sigma_ > 0) reflected_flux_ = reflected_flux_.conjugate().eval();
  Spectrum deviation = transform(kicked_, flux) * number_.cwiseInverse().asDiagonal();
  doublings_.clear();
  for (std::size_t n = 0; n < scalings_.size(); ++n) {
    doublings_.push_back({deviation, scaled(n, deviation)});
    const auto& [here, there] = doublings_.back();
    deviation = here + there + here.cwiseProduct(there);
  }
  product_ = deviation.array() + 1;
  return conserving(inverse_transform(inverse_, reflected_flux_.cwiseProduct(product_)), flux);
}

Flux CollisionOperator::derivative(const Flux& direction) const {
  if (sigma_ == 0) return direction;
  Spectrum reflected = transform(reflected_, direction);
  if (sigma_ > 0) reflected = reflected.conjugate().eval();
  Spectrum change =
      (transform(kicked_, direction) - doublings_.front().here * number(direction).asDiagonal()) *
      number_.cwiseInverse().asDiagonal();
  for (std::size_t n = 0; n < scalings_.size(); ++n) {
    const auto& [here, there] = doublings_[n];
    const Spectrum change_there = scaled(n, change);
    change += change.cwiseProduct(there) + change_there + change_there.cwiseProduct(here);
  }
  const Flux gain =
      inverse_transform(inverse_, reflected.cwiseProduct(product_) + reflected_flux_.cwiseProduct(change));
  return conserving(gain, direction);
}

/// Adds the first three Hermite functions, at the temperature of the flux.
Flux CollisionOperator::conserving(const Flux& gain, const Flux& source) const {
  const Index half = momenta_.size();
  Flux result = gain;
  for (Index column = 0; column < gain.cols(); ++column) {
    const double scale = std::sqrt(temperature_[column]);
    const Eigen::ArrayXd z = momenta_.nodes().array() / scale;
    const Eigen::ArrayXd maxwellian = (-0.5 * z.square()).exp() / (scale * std::sqrt(2 * std::numbers::pi));
    const VectorXd defect = source.col(column) - gain.col(column);
    const Eigen::ArrayXd even = (defect.head(half) + defect.tail(half)).array() * momenta_.weights().array();
    const Eigen::ArrayXd odd = (defect.head(half) - defect.tail(half)).array() * momenta_.weights().array();
    const Eigen::ArrayXd second = z.square() - 1;
    const VectorXd even_part = (even.sum() + 0.5 * (even * second).sum() * second) * maxwellian;
    const VectorXd odd_part = (odd * z).sum() * z * maxwellian;
    result.col(column).head(half) += even_part + odd_part;
    result.col(column).tail(half) += even_part - odd_part;
  }
  return result;
}

Flux CollisionOperator::scatterer_density(const VectorXd& points) const {
  if (sigma_ == 0) {
    const MatrixXd values = momenta_.interpolation(points);
    Flux density(2 * points.size(), flux_.cols());
    density << values * flux_.topRows(momenta_.size()), values * flux_.bottomRows(momenta_.size());
    return density * number_.cwiseInverse().asDiagonal();
  }
  const double c = std::sqrt(c_squared(sigma_));
  return c * inverse_transform(wave_numbers_.fourier(c * points), product_);  // q(k) = g^(c k)
}

}  // namespace lorentz
