// For the study "does the paper hold?" only (panel `momentum`); no figure of the paper needs it.
#pragma once

#include <array>

#include "model/rules/elastic.hpp"

namespace lorentz {

/// Elastic collision, after which the momentum of the scatterer is reversed with a given probability. Energy
/// is conserved, momentum is not, and the particle keeps its memory: u' is that of the elastic rule. The
/// measure [eq. 8] is invariant, as it is symmetric in U.
class Reversal : public Elastic {
 public:
  static constexpr std::array options{
      RuleOption{"probability", "1", "Probability that the scatterer's momentum is reversed", 0, 1}};
  static constexpr RuleProperties properties{
      .name = "reversal",
      .description = "elastic, then the scatterer's momentum is reversed with --reversal-probability",
      .conserves_momentum = false,
      .options = options,
      .conducts = [](double sigma, std::span<const double> values) {
        return elastic_conducts(sigma) || (sigma == 0 && values[0] > 0);
      }};

  Reversal(double sigma, double probability) : Elastic(sigma), probability_(probability) {}

  void operator()(double& u, double& w, std::uint32_t cell, RandomStream& random) const {
    Elastic::operator()(u, w, cell);
    if (random.uniform() < probability_) w = -w;
  }

 private:
  double probability_;
};

}  // namespace lorentz
