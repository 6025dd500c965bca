#pragma once

#include <cmath>
#include <stdexcept>
#include <vector>

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
/// Near +-1, where 1-|sigma| is hardly more than the last digit of 1+|sigma|, the one of the two that is
/// turned round takes the first form and the other one the second: u' = w + sigma (w - u) at +1, w' = u +
/// sigma (w - u) at -1. Then sigma is what was asked for to its last digit.
///
/// With 1+sigma and 1-sigma stored so that they add up to exactly 2, the map of real numbers conserves
/// energy and momentum exactly; only the roundings of the operations remain. The first form is an exact
/// exchange at sigma = 0; the second keeps full relative precision at sigma -> +-1, where the powers of
/// two keep w as large as U.
///
/// The roundings average out only if the coefficient is not close to a fraction with a small
/// denominator: the products of 0.3 with the numbers of a binade fall on ten places between two
/// neighbouring results, all shifted one way, and the energy drifts. So sigma, or 1-|sigma| in the second
/// form, is raised by one part in 1e11, far below every other error; what is left is a random walk
/// (docs/numerics.md has the measurements). 0 and +-1 stay exact.
class CollisionRule {
 public:
  /// Throws std::invalid_argument unless -1 <= sigma <= 1.
  explicit CollisionRule(double sigma) {
    if (!(sigma >= -1 && sigma <= 1)) throw std::invalid_argument("sigma must lie in [-1, 1]");
    if (std::abs(sigma) < 0.5)
      use_exchange_form(detuning * sigma);
    else
      use_relative_form(std::copysign(1.0, sigma), detuning * (1 - std::abs(sigma)));
  }

  /// One collision, in place: u is the particle's, w the scatterer's scaled velocity.
  void operator()(double& u, double& w) const {
    const double from_scatterer = scatterer_weight_ * w, from_particle = particle_weight_ * u;
    const double relative = from_scatterer - from_particle;
    const double particle_base = particle_takes_ ? from_scatterer : u;
    const double scatterer_base = scatterer_takes_ ? from_particle : w;
    u = particle_base + particle_gain_ * relative;
    w = scatterer_base + scatterer_gain_ * relative;
  }

  /// The value that the stored coefficients stand for.
  double sigma() const { return sigma_; }

  /// U / w, in [1/2, 2].
  double scatterer_scale() const { return scatterer_scale_; }

  /// The scatterers' U as w.
  std::vector<double> scaled(std::vector<double> scatterers) const {
    for (double& scatterer : scatterers) scatterer /= scatterer_scale_;
    return scatterers;
  }

  /// Their w as U.
  std::vector<double> unscaled(std::vector<double> scatterers) const {
    for (double& scatterer : scatterers) scatterer *= scatterer_scale_;
    return scatterers;
  }

  /// P / U = sqrt(M). 0 at sigma = 1 as well: an infinitely heavy scatterer is a wall, and its momentum is
  /// left out of every sum.
  double root_mass() const { return root_mass_; }

 private:
  static constexpr double detuning = 1 + 1e-11;

  void use_exchange_form(double sigma) {
    sigma_ = sigma;
    particle_takes_ = scatterer_takes_ = true;
    particle_gain_ = scatterer_gain_ = sigma;
    root_mass_ = scatterer_scale_ = std::sqrt((1 + sigma) / (1 - sigma));
  }

  /// one_minus is 1-|sigma|.
  void use_relative_form(double sign, double one_minus) {
    const bool near_limit = one_minus < 0x1p-10;
    const double whole = near_limit ? 1 : 2;
    const double heavy =
        whole - one_minus;  // rounded to a multiple of 2^-53 or 2^-52, so the next line is exact
    const double light = whole - heavy;
    sigma_ = sign * (1 - light);
    particle_takes_ = near_limit && sign > 0;
    scatterer_takes_ = near_limit && sign < 0;
    particle_gain_ = sign > 0 ? heavy : light;
    scatterer_gain_ = -(sign > 0 ? light : heavy);
    double& partner_weight = sign > 0 ? scatterer_weight_ : particle_weight_;
    double& light_gain = sign > 0 ? scatterer_gain_ : particle_gain_;
    if (light == 0) {  // sigma = +-1: the partner has no say in the relative velocity
      partner_weight = 0;
      root_mass_ = 0;
      return;
    }
    const double mass_ratio = (2 - light) / light;
    const double magnitude = std::ldexp(1.0, std::ilogb(mass_ratio) / 2);
    partner_weight = 1 / magnitude;
    light_gain *= magnitude;
    root_mass_ = std::sqrt(sign > 0 ? mass_ratio : 1 / mass_ratio);
    scatterer_scale_ = sign > 0 ? root_mass_ / magnitude : root_mass_ * magnitude;
  }

  double sigma_ = 0;
  bool particle_takes_ = false;  // the first form, from the scatterer
  bool scatterer_takes_ = false;
  double scatterer_weight_ = 1;
  double particle_weight_ = 1;
  double particle_gain_ = 0;
  double scatterer_gain_ = 0;
  double scatterer_scale_ = 1;
  double root_mass_ = 1;
};

}  // namespace lorentz
