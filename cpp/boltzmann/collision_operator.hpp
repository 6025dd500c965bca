#pragma once

#include <Eigen/SparseCore>
#include <complex>
#include <vector>

#include "boltzmann/panels.hpp"
#include "model/reservoir.hpp"

namespace lorentz {

/// The flux distribution at several places, one column each: F(p) at the nodes p > 0 of a half line, then
/// F(-p) at the same nodes.
using Flux = Eigen::MatrixXd;

/// Normal density with the standard deviation `scale` at z times that.
Eigen::ArrayXd normal_density(const Eigen::ArrayXd& z, double scale);

/// What a bath injects at p > 0: nu sqrt(2/(pi T)) exp(-p^2/2T).
Eigen::VectorXd injected_flux(const Reservoir& bath, const Eigen::VectorXd& p);

/// What scattering makes of the flux F of particles when the scatterer is in its stationary state g:
///
///   G(u) = int dU F(u') g(U'),   J g(U) = int du F(u') g(U'),   J = int F du,
///   u' = -sigma u + c U,  U' = c u + sigma U,  c^2 = 1 - sigma^2.
///
/// The second equation says that U performs the autoregressive process U' = sigma U + c v, v drawn from F/J.
/// So with phi the characteristic function of F/J, that of g is prod_{j>=0} phi(c sigma^j k), and
///
///   G^(k) = J phi(-sigma k) q(k),   q(k) = prod_{j>=0} phi(c^2 sigma^j k).
///
/// F jumps at 0 and g nearly does for small sigma, so phi and G^ fall off slowly; but for large k they vary
/// on the scale of k only. Panels that grow with k resolve them, as panels that shrink towards 0 resolve F.
/// The product is formed by doubling, q_{2n}(k) = q_n(k) q_n(sigma^n k), interpolated on its panels; q_n - 1
/// is what is stored, as thousands of factors close to 1 are multiplied when |sigma| is close to 1.
///
/// Fluxes are given as deviations F - E from an equilibrium E, the same on both half lines, whose gain is E
/// itself and whose factors are known: G - E is computed as a difference, so that an equilibrium stays one to
/// the last digit, however often particles scatter.
class CollisionOperator {
 public:
  /// sigma in (-1, 1). E is what the equilibrium bath injects, on either side. The momenta are those of one
  /// half line; k must reach so far that G^ has decayed.
  CollisionOperator(double sigma, const Reservoir& equilibrium, const Panels& momenta,
                    const Panels& wave_numbers);

  /// G - E of F - E. The operator remembers F for derivative() and scatterer_density(). Number, momentum and
  /// energy of G are set to those of F, so that rounding and truncation do not add up along the line.
  Flux gain(const Flux& deviation);

  /// dG at the flux of the last gain(), in the direction given; one column for each of its columns.
  Flux derivative(const Flux& direction) const;

  /// <p^2> at the flux of the last gain().
  const Eigen::RowVectorXd& temperature() const { return temperature_; }

  /// g at the flux of the last gain(): values of the density of U at points, then at minus the points.
  Flux scatterer_density(const Eigen::VectorXd& points) const;

 private:
  using Spectrum = Eigen::Matrix<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  using Scaling = Eigen::SparseMatrix<double, Eigen::RowMajor>;

  Spectrum transform(const FourierIntegrals& integrals, const Flux& flux) const;
  Flux inverse_transform(const FourierIntegrals& integrals, const Spectrum& spectrum) const;
  Spectrum scaled(std::size_t doubling, const Spectrum& spectrum) const;
  Spectrum reflected(const Flux& flux) const;
  Spectrum first_change(const Flux& change, const Spectrum& before) const;
  Eigen::RowVectorXd number(const Flux& flux) const;
  Flux conserving(const Flux& gain, const Flux& source) const;

  double sigma_;
  Reservoir equilibrium_;
  Panels momenta_, wave_numbers_;
  FourierIntegrals reflected_, kicked_, inverse_;  // at sigma k; at c^2 k, minus J; back to the momenta
  std::vector<Scaling> scalings_;                  // by |sigma|^(2^n)

  struct EquilibriumFactors {
    Eigen::VectorXcd here, there;  // q_n(k) - 1, q_n(sigma^n k) - 1 of the equilibrium
  };
  std::vector<EquilibriumFactors> equilibrium_doublings_;
  Eigen::VectorXcd equilibrium_product_, reflected_equilibrium_;  // q(k) - 1, J phi(sigma k)

  struct Factors {
    Spectrum here, there;  // q_n(k) - 1, q_n(sigma^n k) - 1
  };
  Flux deviation_;
  Eigen::RowVectorXd number_, temperature_;  // of F
  Spectrum reflected_flux_, product_;
  std::vector<Factors> doublings_;
};

}  // namespace lorentz
