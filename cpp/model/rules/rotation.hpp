// For the study "does the paper hold?" only (panel `momentum`); no figure of the paper needs it.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "model/rules/elastic.hpp"

namespace lorentz {

/// Elastic collision, after which, with a given probability, the momenta of the particle, of its scatterer
/// and of a neighbouring scatterer move to a uniformly random point on the circle of equal total energy and
/// momentum: noise that conserves both [eq. 4].
///
/// In energy-normalised velocities (u, U, U') energy is the square of the length, and momentum the component
/// along n = (1, sqrt(M), sqrt(M))/sqrt(1 + 2M), so that the circle is a rotation about n by an angle uniform
/// in [0, 2 pi). The measure [eq. 8] is invariant, as its density depends on the length alone, and the rule
/// is reversible in distribution, as an angle and its opposite are equally probable.
class Rotation : public Elastic {
 public:
  static constexpr std::array options{
      RuleOption{"probability", "1",
                 "Probability that the momenta of the particle and of two scatterers are rotated", 0, 1}};
  static constexpr RuleProperties properties{
      .name = "rotation",
      .description =
          "elastic, then with --rotation-probability particle, scatterer and a neighbouring "
          "scatterer exchange energy and momentum at random",
      .conserves_momentum = true,
      .options = options,
      .conducts =
          [](double sigma, std::span<const double> values) {
            return elastic_conducts(sigma) || (sigma > -1 && values[0] > 0);
          },
      .changes_neighbour = true};

  Rotation(double sigma, double probability) : Elastic(sigma), probability_(probability) {
    if (sigma == 1) return;  // M is infinite
    const double length = std::sqrt(2 * (1 + 2 * root_mass() * root_mass()));
    particle_part_ = 2 * root_mass() / length;
    scatterer_part_ = -1 / length;
  }

  void operator()(double& u, double& w, double& neighbour, std::uint32_t cell, RandomStream& random) const {
    Elastic::operator()(u, w, cell);
    if (!(random.uniform() < probability_)) return;
    const double angle = 2 * std::numbers::pi * random.uniform();
    const double cosine = std::cos(angle), sine = std::sin(angle), scale = scatterer_scale();
    const double U = scale * w, other = scale * neighbour;
    // Components along (0, 1, -1)/sqrt(2) and along the third axis of n and that one.
    const double a = (U - other) * half_root, b = particle_part_ * u + scatterer_part_ * (U + other);
    const double da = (cosine - 1) * a - sine * b, db = sine * a + (cosine - 1) * b;
    u += particle_part_ * db;
    w = (U + half_root * da + scatterer_part_ * db) / scale;
    neighbour = (other - half_root * da + scatterer_part_ * db) / scale;
  }

 private:
  static constexpr double half_root = 1 / std::numbers::sqrt2;
  double probability_;
  double particle_part_ = 1, scatterer_part_ = 0;  // of the third axis
};

}  // namespace lorentz
