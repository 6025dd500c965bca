#pragma once

#include <Eigen/SparseCore>
#include <complex>
#include <vector>

#include "boltzmann/panels.hpp"
#include "model/reservoir.hpp"

namespace lorentz {

/// Flux distributions at several positions, one column each: F(p) at the nodes p > 0 of a half line, then
/// F(-p) at the same nodes. Units: 1/(time momentum).
using Flux = Eigen::MatrixXd;

/// Normal density of the standard deviation `scale` at scale z.
Eigen::ArrayXd normal_density(const Eigen::ArrayXd& z, double scale);

/// Flux that a bath injects at p > 0, nu sqrt(2/(pi T)) exp(-p^2/2T) [eq. 5].
Eigen::VectorXd injected_flux(const Reservoir& bath, const Eigen::VectorXd& p);

/// Gain G of scattering for the flux F of particles, with the scatterer in its stationary state g [eq. 36]:
///
///   G(u) = int dU F(u') g(U'),   J g(U) = int du F(u') g(U'),   J = int F du,
///   u' = -sigma u + c U,  U' = c u + sigma U,  c^2 = 1 - sigma^2.
///
/// By the second equation, g is the stationary density of the autoregressive process U' = sigma U + c v with
/// v drawn from F/J [eq. 37]. With phi the characteristic function of F/J, that of g is prod_{j>=0} phi(c
/// sigma^j k), and [eq. 38]
///
///   G^(k) = J phi(-sigma k) q(k),   q(k) = prod_{j>=0} phi(c^2 sigma^j k).
///
/// F is discontinuous at 0, and g nearly so for small sigma, so phi and G^ decay slowly; but at large k they
/// vary only on the scale of k. Panels that grow with k resolve them, as panels that shrink towards 0 resolve
/// F. The product is computed by doubling, q_{2n}(k) = q_n(k) q_n(sigma^n k), with interpolation on its
/// panels; q_n - 1 is stored, because for |sigma| close to 1 thousands of factors close to 1 are multiplied.
///
/// Fluxes are given as deviations F - E from an equilibrium E that is the same on both half lines. Its gain
/// is E, and its factors are known in closed form. G - E is computed without cancellation, so that an
/// equilibrium remains one to the last digit for every gamma.
class CollisionOperator {
 public:
  /// -1 < sigma < 1. `equilibrium` is the bath that injects E on either side. `momenta` are panels on one
  /// half line; `wave_numbers` must extend to where G^ has decayed.
  CollisionOperator(double sigma, const Reservoir& equilibrium, const Panels& momenta,
                    const Panels& wave_numbers);

  /// G - E for the deviation F - E. F is stored for derivative() and scatterer_density(). Number, momentum
  /// and energy of G are set to those of F, so that rounding and truncation errors do not accumulate along
  /// the chain.
  Flux gain(const Flux& deviation);

  /// Derivative of G at the flux of the last gain(), column by column in the given directions.
  Flux derivative(const Flux& direction) const;

  /// Density g of U at the flux of the last gain(), at points, then at minus the points.
  Flux scatterer_density(const Eigen::VectorXd& points) const;

 private:
  using Spectrum = Eigen::Matrix<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  using Scaling = Eigen::SparseMatrix<double, Eigen::RowMajor>;

  Spectrum transform(const FourierIntegrals& integrals, const Flux& flux) const;
  static Flux inverse_transform(const FourierIntegrals& integrals, const Spectrum& spectrum);
  Spectrum scaled(std::size_t doubling, const Spectrum& spectrum) const;
  Spectrum reflected(const Flux& flux) const;
  Spectrum first_change(const Flux& change, const Spectrum& before) const;
  Eigen::RowVectorXd number(const Flux& flux) const;
  Flux conserving(const Flux& gain, const Flux& source) const;

  double sigma_;
  Reservoir equilibrium_;
  Panels momenta_, wave_numbers_;
  FourierIntegrals reflected_, kicked_, inverse_;  // to |sigma| k; to c^2 k, minus J; back to the momenta
  std::vector<Scaling> scalings_;                  // k to |sigma|^(2^n) k

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
