#pragma once

#include <cmath>
#include <stdexcept>

#include "model/rules/elastic.hpp"

namespace lorentz {

/// The elastic collision computed as the paper prints it [eq. 1], in momenta with sigma as given: for the
/// comparison of rounding errors with those of Elastic (docs/numerics.md). w is the momentum P.
class Printed : public Elastic {
 public:
  static constexpr RuleProperties properties{.name = "printed",
                                             .description = "elastic, rounded as in the paper's formula",
                                             .conserves_momentum = true,
                                             .conducts = elastic_conducts};

  /// Throws std::invalid_argument unless -1 < sigma < 1.
  explicit Printed(double sigma) : Elastic(sigma), given_(sigma) {
    if (std::abs(sigma) == 1) throw std::invalid_argument("sigma must lie between -1 and 1");
    const double root_mass = std::sqrt((1 + sigma) / (1 - sigma));
    set_scale(root_mass, 1 / root_mass);
  }

  void operator()(double& p, double& P, std::uint32_t /*cell*/) const {
    const double before = p;
    p = -given_ * before + (1 - given_) * P;
    P = (1 + given_) * before + given_ * P;
  }

 private:
  double given_;
};

}  // namespace lorentz
