#pragma once

#include <cmath>

#include "model/rules/elastic.hpp"

namespace lorentz {

/// Elastic collision, after which the direction of the particle is drawn at random: the paper's control.
/// Energy is conserved, momentum is not; the measure [eq. 8] is invariant, as it is symmetric in u.
class RandomDirection : public Elastic {
 public:
  static constexpr RuleProperties properties{
      .name = "random-direction",
      .description = "elastic, then the direction of the particle is drawn",
      .conserves_momentum = false,
      .conducts = [](double sigma, std::span<const double>) { return sigma > -1 && sigma < 1; }};

  using Elastic::Elastic;

  void operator()(double& u, double& w, std::uint32_t cell, RandomStream& random) const {
    Elastic::operator()(u, w, cell);
    draw_direction(u, random);
  }

  static void draw_direction(double& u, RandomStream& random) {
    u = std::copysign(u, random.uniform() - 0.5);
  }
};

}  // namespace lorentz
