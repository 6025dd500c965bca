#include "boltzmann/collision_operator.hpp"

#include <cmath>
#include <numbers>

namespace lorentz {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;
using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr double last_scale = 1e-17;  // sigma^j at which the product is truncated

double c_squared(double sigma) { return (1 - sigma) * (1 + sigma); }

/// Base-2 logarithm of the number of factors of the product.
int doublings(double sigma) {
  const double factors = std::log(last_scale) / std::log(std::abs(sigma));
  return std::max(1, static_cast<int>(std::ceil(std::log(factors) / std::numbers::ln2)));
}

/// Matrix from the values of a function at the nodes k to its values at scale k, for functions that vanish at
/// 0. It interpolates the function divided by k, so that errors near k = 0 do not accumulate over many
/// factors.
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

/// q_n(k) - 1 of the equilibrium in closed form, q_n = product over j < n of exp(-T (c^2 sigma^j k)^2/2), n =
/// 2^doubling.
VectorXcd equilibrium_product(double sigma, double temperature, int doubling, const Eigen::ArrayXd& k) {
  const double last = std::pow(sigma * sigma, std::ldexp(1, doubling));
  const double variance = temperature * c_squared(sigma) * (1 - last);
  return (-0.5 * variance * k.square()).expm1().cast<std::complex<double>>();
}

}  // namespace

Eigen::ArrayXd normal_density(const Eigen::ArrayXd& z, double scale) {
  return (-0.5 * z.square()).exp() / (scale * std::sqrt(2 * std::numbers::pi));
}

VectorXd injected_flux(const Reservoir& bath, const VectorXd& p) {
  const double height = bath.rate * std::sqrt(2 / (std::numbers::pi * bath.temperature));
  return height * (-p.array().square() / (2 * bath.temperature)).exp();
}

CollisionOperator::CollisionOperator(double sigma, const Reservoir& equilibrium, const Panels& momenta,
                                     const Panels& wave_numbers)
    : sigma_(sigma), equilibrium_(equilibrium), momenta_(momenta), wave_numbers_(wave_numbers) {
  if (sigma == 0) return;  // momenta are exchanged: G = F and J g = F
  reflected_ = momenta.fourier(std::abs(sigma) * wave_numbers.nodes());
  kicked_ = momenta.fourier(c_squared(sigma) * wave_numbers.nodes());
  kicked_.cosine = kicked_.cosine_minus_one;
  inverse_ = wave_numbers.fourier(momenta.nodes());
  const Eigen::ArrayXd k = wave_numbers.nodes().array();
  const double temperature = equilibrium.temperature;
  for (int n = 0; n < doublings(sigma); ++n) {
    const double scale = std::pow(std::abs(sigma), std::ldexp(1, n));
    scalings_.push_back(scaling(wave_numbers, scale));
    equilibrium_doublings_.push_back({equilibrium_product(sigma, temperature, n, k),
                                      equilibrium_product(sigma, temperature, n, scale * k)});
  }
  equilibrium_product_ = equilibrium_product(sigma, temperature, doublings(sigma), k);
  reflected_equilibrium_ = (2 * equilibrium.rate * (-0.5 * sigma * sigma * temperature * k.square()).exp())
                               .cast<std::complex<double>>();
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

Flux CollisionOperator::inverse_transform(const FourierIntegrals& integrals, const Spectrum& spectrum) {
  const MatrixXd even = integrals.cosine * spectrum.real() / std::numbers::pi;
  const MatrixXd odd = integrals.sine * spectrum.imag() / std::numbers::pi;
  Flux flux(2 * even.rows(), even.cols());
  flux << even + odd, even - odd;
  return flux;
}

/// Spectrum J phi(-sigma k) of the reflected flux [eq. 38].
CollisionOperator::Spectrum CollisionOperator::reflected(const Flux& flux) const {
  const Spectrum spectrum = transform(reflected_, flux);
  return sigma_ > 0 ? Spectrum(spectrum.conjugate()) : spectrum;
}

/// Exact change of phi(c^2 k) - 1, which is `before` without the change, when `change` is added to the flux
/// and the number becomes J = number_; for a small change, the derivative.
CollisionOperator::Spectrum CollisionOperator::first_change(const Flux& change,
                                                            const Spectrum& before) const {
  return (transform(kicked_, change) - before * number(change).asDiagonal()) *
         number_.cwiseInverse().asDiagonal();
}

/// Spectrum at sigma^(2^doubling) k. A negative factor, possible for the first doubling only, gives the
/// complex conjugate.
CollisionOperator::Spectrum CollisionOperator::scaled(std::size_t doubling, const Spectrum& spectrum) const {
  Spectrum result(spectrum.rows(), spectrum.cols());
  const Eigen::Map<const RowMajorMatrix> from(reinterpret_cast<const double*>(spectrum.data()),
                                              spectrum.rows(), 2 * spectrum.cols());
  Eigen::Map<RowMajorMatrix> to(reinterpret_cast<double*>(result.data()), result.rows(), 2 * result.cols());
  to.noalias() = scalings_[doubling] * from;
  if (doubling == 0 && sigma_ < 0) result = result.conjugate().eval();
  return result;
}

Flux CollisionOperator::gain(const Flux& deviation) {
  deviation_ = deviation;
  number_ = number(deviation).array() + 2 * equilibrium_.rate;
  const Index half = momenta_.size();
  const RowVectorXd squares =
      (momenta_.weights().array() * momenta_.nodes().array().square()).matrix().transpose() *
      (deviation.topRows(half) + deviation.bottomRows(half));
  temperature_ = (squares.array() + 2 * equilibrium_.rate * equilibrium_.temperature) / number_.array();
  if (sigma_ == 0) return deviation;
  const Spectrum reflected_deviation = reflected(deviation);
  reflected_flux_ = reflected_deviation.colwise() + reflected_equilibrium_;
  Spectrum change =
      first_change(deviation, equilibrium_doublings_.front().here.replicate(1, deviation.cols()));
  // q_{2n}(k) = q_n(k) q_n(sigma^n k), written for the change of q_n - 1 from its equilibrium value.
  doublings_.clear();
  for (std::size_t n = 0; n < scalings_.size(); ++n) {
    const auto& [here, there] = equilibrium_doublings_[n];
    const Spectrum change_there = scaled(n, change);
    doublings_.push_back({change.colwise() + here, change_there.colwise() + there});
    change += change.cwiseProduct(doublings_.back().there) + change_there + here.asDiagonal() * change_there;
  }
  product_ = (change.colwise() + equilibrium_product_).array() + 1;
  const Spectrum gain =
      reflected_deviation.cwiseProduct(product_) + reflected_equilibrium_.asDiagonal() * change;
  return conserving(inverse_transform(inverse_, gain), deviation);
}

Flux CollisionOperator::derivative(const Flux& direction) const {
  if (sigma_ == 0) return direction;
  Spectrum change = first_change(direction, doublings_.front().here);
  for (std::size_t n = 0; n < scalings_.size(); ++n) {
    const auto& [here, there] = doublings_[n];
    const Spectrum change_there = scaled(n, change);
    change += change.cwiseProduct(there) + change_there + change_there.cwiseProduct(here);
  }
  const Spectrum gain = reflected(direction).cwiseProduct(product_) + reflected_flux_.cwiseProduct(change);
  return conserving(inverse_transform(inverse_, gain), direction);
}

/// Adds the first three Hermite functions at the temperature of the flux, so that the number, momentum and
/// energy of the gain equal those of the source.
Flux CollisionOperator::conserving(const Flux& gain, const Flux& source) const {
  const Index half = momenta_.size();
  Flux result = gain;
  for (Index column = 0; column < gain.cols(); ++column) {
    const double scale = std::sqrt(temperature_[column]);
    const Eigen::ArrayXd z = momenta_.nodes().array() / scale;
    const Eigen::ArrayXd maxwellian = normal_density(z, scale);
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
    const Index half = momenta_.size();
    Flux flux(2 * points.size(), deviation_.cols());
    flux << values * deviation_.topRows(half), values * deviation_.bottomRows(half);
    flux.colwise() += injected_flux(equilibrium_, points).replicate(2, 1).col(0);
    return flux * number_.cwiseInverse().asDiagonal();
  }
  const double c = std::sqrt(c_squared(sigma_));
  return c * inverse_transform(wave_numbers_.fourier(c * points), product_);  // q(k) = g^(c k)
}

}  // namespace lorentz
