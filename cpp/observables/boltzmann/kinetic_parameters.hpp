#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "boltzmann/fields.hpp"
#include "model/reservoir.hpp"
#include "program/options.hpp"
#include "sampling/chain_parameters.hpp"
#include "sampling/momentum_bins.hpp"

namespace lorentz {

/// Parameters of the Boltzmann equation of an open chain. Defaults: figure 3 of the paper.
struct KineticParameters {
  double sigma = 0.5;
  std::optional<double> gamma = 1;       // none: N, one scattering at each of the cells
  std::optional<std::uint32_t> cells{};  // none: continuum
  RuleParameters rule{};
  Reservoir left = default_left, right = default_right;
  std::vector<double> positions{0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1};
  MomentumBinParameters bins;
  double target_error = 1e-10;
  std::uint32_t coarsening = 0;

  KineticProblem problem() const;
  FieldGrid grid() const;  // of the output: --positions, or the bonds and scatterers of a chain
};

void declare(Options& options, KineticParameters& parameters);

/// Throws UsageError if options that are valid one by one exclude each other.
void validate(const KineticParameters& parameters, bool positions_given);

}  // namespace lorentz
