#pragma once

#include <cmath>
#include <concepts>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

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
/// u + c U, U' = c u + sigma U with c^2 = 1 - sigma^2 [eq. 2]. This form is not used: because c is rounded,
/// sigma^2 + c^2 differs from 1 by a constant, and the energy drifts linearly with the number of collisions.
/// The code uses velocities [eq. 3]: the scatterer is stored as w = U / scatterer_scale(), its velocity up to
/// a power of two, and a multiple of the relative velocity is added,
///
///   |sigma| <  1/2:  u' = w + sigma (w - u)               w' = u + sigma (w - u)
///   |sigma| >= 1/2:  u' = u + (1+sigma) (w - u)           w' = w - (1-sigma) (w - u)
///
/// For 1-|sigma| < 2^-10, the velocity that is reversed has the first form, u' at sigma = 1 and w' at sigma =
/// -1, and the other one the second form. The stored sigma is then accurate to its last digit, although
/// 1-|sigma| is close to the last digit of 1+|sigma|.
///
/// The stored 1+sigma and 1-sigma add up to exactly 2, so that the map of real numbers conserves energy and
/// momentum exactly, and errors come only from the rounding of each operation. The first form is an exact
/// exchange at sigma = 0. The second form has full relative precision at sigma -> +-1, where the powers of
/// two keep w and U of the same order of magnitude.
///
/// Rounding errors have mean 0 only if the coefficient is not close to a fraction with a small denominator.
/// Products with 0.3, for example, have only ten different remainders relative to the spacing of the results;
/// their rounding errors have the same sign on average, and the energy drifts. Therefore sigma, or 1-|sigma|
/// in the second form, is multiplied by 1 + 1e-11, a change far below every other error. The remaining energy
/// error is a random walk (docs/numerics.md). 0 and +-1 are exact.
class Elastic {
 public:
  static constexpr RuleProperties properties{.name = "elastic",
                                             .description = "energy and momentum are conserved",
                                             .conserves_momentum = true,
                                             .conducts = elastic_conducts};

  /// Throws std::invalid_argument unless -1 <= sigma <= 1.
  explicit Elastic(double sigma) {
    if (!(sigma >= -1 && sigma <= 1)) throw std::invalid_argument("sigma must lie in [-1, 1]");
    if (std::abs(sigma) < 0.5)
      use_exchange_form(detuning * sigma);
    else
      use_relative_form(std::copysign(1.0, sigma), detuning * (1 - std::abs(sigma)));
  }

  /// One collision, in place: u is the velocity of the particle, w the scaled velocity of the scatterer [eq.
  /// 3].
  void operator()(double& u, double& w, std::uint32_t /*cell*/) const {
    const double from_scatterer = scatterer_weight_ * w, from_particle = particle_weight_ * u;
    const double relative = from_scatterer - from_particle;
    const double particle_base = particle_takes_ ? from_scatterer : u;
    const double scatterer_base = scatterer_takes_ ? from_particle : w;
    u = particle_base + particle_gain_ * relative;
    w = scatterer_base + scatterer_gain_ * relative;
  }

  /// Whether the rule is that of RelativeElastic.
  bool relative_form() const { return !particle_takes_ && !scatterer_takes_; }

  /// sigma of the stored, rounded coefficients.
  double sigma() const { return sigma_; }

  /// The ratio U / w, in [1/2, 2].
  double scatterer_scale() const { return scatterer_scale_; }

  /// Converts U of the scatterers to w.
  std::vector<double> scaled(std::vector<double> scatterers) const {
    for (double& scatterer : scatterers) scatterer /= scatterer_scale_;
    return scatterers;
  }

  /// Converts w of the scatterers to U.
  std::vector<double> unscaled(std::vector<double> scatterers) const {
    for (double& scatterer : scatterers) scatterer *= scatterer_scale_;
    return scatterers;
  }

  /// P / U = sqrt(M). At sigma = 1, where M is infinite, it is 0, so that the scatterers' momenta are left
  /// out of every sum.
  double root_mass() const { return root_mass_; }

 protected:
  /// For rules with another unit of w.
  void set_scale(double root_mass, double scatterer_scale) {
    root_mass_ = root_mass;
    scatterer_scale_ = scatterer_scale;
  }

  /// The second form.
  void relative(double& u, double& w) const {
    const double relative = scatterer_weight_ * w - particle_weight_ * u;
    u += particle_gain_ * relative;
    w += scatterer_gain_ * relative;
  }

 private:
  static constexpr double detuning = 1 + 1e-11;

  void use_exchange_form(double sigma) {
    sigma_ = sigma;
    particle_takes_ = scatterer_takes_ = true;
    particle_gain_ = scatterer_gain_ = sigma;
    root_mass_ = scatterer_scale_ = std::sqrt((1 + sigma) / (1 - sigma));
  }

  /// `one_minus` is 1-|sigma|.
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
    if (light == 0) {  // sigma = +-1: the velocity of the infinitely heavier partner vanishes
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
  bool particle_takes_ = false;   // u' has the first form, which starts from w
  bool scatterer_takes_ = false;  // w' has the first form, which starts from u
  double scatterer_weight_ = 1;
  double particle_weight_ = 1;
  double particle_gain_ = 0;
  double scatterer_gain_ = 0;
  double scatterer_scale_ = 1;
  double root_mass_ = 1;
};

/// The same for |sigma| >= 1/2, with fewer operations.
class RelativeElastic : public Elastic {
 public:
  explicit RelativeElastic(const Elastic& rule) : Elastic(rule) {}
  void operator()(double& u, double& w, std::uint32_t /*cell*/) const { relative(u, w); }
};

/// Calls advance(rule), with the form that needs fewer operations.
template <class Rule, class Advance>
void with_form(const Rule& rule, const Advance& advance) {
  if constexpr (std::same_as<Rule, Elastic>) {
    if (rule.relative_form()) return advance(RelativeElastic(rule));
  }
  advance(rule);
}

}  // namespace lorentz
