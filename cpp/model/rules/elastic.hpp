#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <stdexcept>

#include "model/collision_rule.hpp"

namespace lorentz {

/// Equal masses exchange momenta only; masses of 0 and infinity exchange no energy.
constexpr bool elastic_conducts(double sigma, std::span<const double> /*options*/ = {}) {
  return sigma != 0 && sigma > -1 && sigma < 1;
}

/// Elastic collision of a particle with a fixed scatterer, p' = -sigma p + (1-sigma) P and P' = (1+sigma) p +
/// sigma P with sigma = (M-m)/(M+m) [eq. 1] (Collet, Eckmann, Mejia-Monasterio 2009).
///
/// In energy-normalised variables u = p/sqrt(m), U = P/sqrt(M) this is the orthogonal reflection u' = -sigma
/// u + c U, U' = c u + sigma U with c^2 = 1 - sigma^2 [eq. 2]. If c is rounded, sigma^2 + c^2 differs from 1
/// by a constant, and the energy drifts linearly with the number of collisions. Therefore the scatterer is
/// stored as w = U / scatterer_scale(), its velocity up to a power of two m, with which c has two factors
/// that are stored exactly:
///
///   u' = (1+sigma)/m w - sigma u               w' = (1-sigma) m u + sigma w
///
/// This map of real numbers conserves energy and momentum, as (1+sigma)(1-sigma) + sigma^2 is exactly 1, and
/// errors come only from the rounding of each operation. m is close to sqrt(M), so that w and U are of the
/// same order of magnitude. sigma is written as a whole number, -1, 0 or 1, minus a rest, and the product
/// with the whole number, which is exact, is added last. At sigma = 0 and +-1 the collision is exact. Close
/// to +-1 the rounding error of a product with sigma itself would be nearly the same in thousands of
/// collisions of a scatterer, as its velocity hardly changes.
class Elastic : public ScattererMass {
 public:
  static constexpr RuleProperties properties{.name = "elastic",
                                             .description = "energy and momentum are conserved",
                                             .conserves_momentum = true,
                                             .conducts = elastic_conducts};

  /// Throws std::invalid_argument unless -1 <= sigma <= 1.
  explicit Elastic(double sigma) : sigma_(stored(sigma)) {
    if (!(sigma >= -1 && sigma <= 1)) throw std::invalid_argument("sigma must lie in [-1, 1]");
    if (std::abs(sigma) == 1) return;  // c = 0
    const double mass = scatterer_mass(sigma_), root_mass = std::sqrt(mass);
    const double magnitude = std::ldexp(1.0, std::ilogb(mass) / 2);
    particle_from_scatterer_ = (1 + sigma_) / magnitude;
    scatterer_from_particle_ = (1 - sigma_) * magnitude;
    set_mass(root_mass, root_mass / magnitude);  // the scale is in [1/2, 2]
  }

  /// One collision, in place: u is the velocity of the particle, w the scaled velocity of the scatterer.
  void operator()(double& u, double& w, std::uint32_t /*cell*/) const {
    const double particle = u, scatterer = w;
    u = (particle_from_scatterer_ * scatterer + rest_ * particle) - whole_ * particle;
    w = (scatterer_from_particle_ * particle - rest_ * scatterer) + whole_ * scatterer;
  }

  /// sigma as it is stored.
  double sigma() const { return sigma_; }

 private:
  /// sigma, changed by at most 1e-11 sigma (1-|sigma|) + 2^-53, which is far below every other error.
  ///
  /// Rounding errors have mean 0 only if the coefficient is not close to a fraction with a small denominator.
  /// Products with 0.3, for example, have only ten different remainders relative to the spacing of the
  /// results; their rounding errors have the same sign on average, and the energy drifts. The first line
  /// avoids these fractions; 0 and +-1 stay. The second makes 1+sigma and 1-sigma exact. Not for 1-|sigma| <
  /// 2^-10, where sigma is accurate to its last digit: there an error of 1+|sigma| is multiplied by
  /// 1-|sigma|, and changes the energy by less than 2^-63 per collision.
  static double stored(double sigma) {
    const double detuned = sigma + 1e-11 * sigma * (1 - std::abs(sigma));
    if (1 - std::abs(sigma) < 0x1p-10) return detuned;
    return std::copysign((1 + std::abs(detuned)) - 1, sigma);
  }

  double sigma_;
  double whole_ = std::nearbyint(sigma_);
  double rest_ = whole_ - sigma_;
  double particle_from_scatterer_ = 0;
  double scatterer_from_particle_ = 0;
};

}  // namespace lorentz
