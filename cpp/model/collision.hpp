#pragma once

#include <cmath>
#include <stdexcept>

namespace lorentz {

/// Scattering of a particle off a fixed scatterer, p' = -sigma p + (1-sigma) P and
/// P' = (1+sigma) p + sigma P, with sigma = (M-m)/(M+m) (Collet, Eckmann, Mejia-Monasterio 2009).
///
/// In energy-normalised variables u = p/sqrt(m), U = P/sqrt(M) this is the orthogonal reflection
/// u' = -sigma u + c U, U' = c u + sigma U with c^2 = 1 - sigma^2. Coded like that, the rounding of
/// c makes sigma^2 + c^2 miss 1 always on the same side, and the energy drifts linearly with the
/// number of collisions. The scatterer is therefore kept as w = U / scatterer_scale(), a velocity
/// up to a power of two, and a multiple of the relative velocity is added:
///
///   |sigma| <  1/2:  u' = w + sigma (w - u)               w' = u + sigma (w - u)
///   |sigma| >= 1/2:  u' = u + (1+sigma) (w - u)           w' = w - (1-sigma) (w - u)
///
/// With sigma exact (first form), or 1+sigma and 1-sigma stored so that they add up to exactly 2
/// (second form), the map of real numbers conserves energy and momentum exactly; only the roundings
/// of the operations remain, and they form a random walk (docs/numerics.md has the measurement).
/// The first form is an exact exchange at sigma = 0; the second keeps full relative precision at
/// sigma -> +-1, where the powers of two keep w as large as U.
///
/// In the second form sigma is rounded to a multiple of 2^-52.
class CollisionRule {
 public:
  /// Throws std::invalid_argument unless -1 <= sigma <= 1.
  explicit CollisionRule(double sigma) {
    if (!(sigma >= -1 && sigma <= 1)) throw std::invalid_argument("sigma must lie in [-1, 1]");
    if (std::abs(sigma) < 0.5) {
      exchange_ = true;
      particle_gain_ = scatterer_gain_ = sigma;
      root_mass_ = scatterer_scale_ = std::sqrt((1 + sigma) / (1 - sigma));
      return;
    }
    // The larger of the two is rounded to a multiple of 2^-52; then the subtraction is exact.
    const double heavy = 1 + std::abs(sigma);
    const double light = 2 - heavy;
    const int exponent = light > 0 ? std::ilogb(heavy / light) / 2 : 0;
    const double magnitude = std::ldexp(1.0, exponent);
    const double limit = light > 0 ? 1 : 0;  // at sigma = +-1 the partner drops out of w - u
    const double root_ratio = light > 0 ? std::sqrt(heavy / light) : 0;
    const double scale = light > 0 ? root_ratio / magnitude : 1;
    if (sigma > 0) {
      scatterer_weight_ = limit / magnitude;
      particle_gain_ = heavy;
      scatterer_gain_ = -light * magnitude;
      scatterer_scale_ = scale;
      root_mass_ = root_ratio;
    } else {
      particle_weight_ = limit / magnitude;
      particle_gain_ = light * magnitude;
      scatterer_gain_ = -heavy;
      scatterer_scale_ = 1 / scale;
      root_mass_ = light > 0 ? 1 / root_ratio : 0;
    }
  }

  /// One collision, in place: u is the particle's, w the scatterer's scaled velocity.
  void operator()(double& u, double& w) const {
    const double relative = scatterer_weight_ * w - particle_weight_ * u;
    const double particle_base = exchange_ ? w : u;
    const double scatterer_base = exchange_ ? u : w;
    u = particle_base + particle_gain_ * relative;
    w = scatterer_base + scatterer_gain_ * relative;
  }

  /// U / w, in [1/2, 2].
  double scatterer_scale() const { return scatterer_scale_; }

  /// P / U = sqrt(M), of the mass that the stored coefficients stand for. 0 at sigma = 1 as well: an
  /// infinitely heavy scatterer is a wall, and its momentum is left out of every sum.
  double root_mass() const { return root_mass_; }

 private:
  bool exchange_ = false;
  double scatterer_weight_ = 1;
  double particle_weight_ = 1;
  double particle_gain_ = 0;
  double scatterer_gain_ = 0;
  double scatterer_scale_ = 1;
  double root_mass_ = 1;
};

}  // namespace lorentz
