#pragma once

#include <cmath>
#include <stdexcept>

#include "model/rules/elastic.hpp"

namespace lorentz {

/// The elastic collision computed as the paper prints it [eq. 1], in momenta with sigma as given: for the
/// comparison of rounding errors with those of Elastic (docs/numerics.md). w is the momentum P.
class Printed : public ScattererMass {
 public:
  static constexpr RuleProperties properties{.name = "printed",
                                             .description = "elastic, rounded as in the paper's formula",
                                             .conserves_momentum = true,
                                             .conducts = elastic_conducts};

  /// Throws std::invalid_argument unless -1 < sigma < 1.
  explicit Printed(double sigma) : sigma_(sigma) {
    if (!(std::abs(sigma) < 1)) throw std::invalid_argument("sigma must lie between -1 and 1");
    const double root_mass = std::sqrt(scatterer_mass(sigma));
    set_mass(root_mass, 1 / root_mass);
  }

  void operator()(double& p, double& P, std::uint32_t /*cell*/) const {
    const double before = p;
    p = -sigma_ * before + (1 - sigma_) * P;
    P = (1 + sigma_) * before + sigma_ * P;
  }

 private:
  double sigma_;
};

}  // namespace lorentz
