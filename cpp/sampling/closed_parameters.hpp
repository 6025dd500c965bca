#pragma once

#include <optional>

#include "engine/stationary_start.hpp"
#include "model/closed_chain.hpp"
#include "program/options.hpp"
#include "sampling/chain_parameters.hpp"

namespace lorentz {

/// Parameters of a closed chain, its initial state and its measurement. Defaults: figure 5 of the paper.
struct ClosedParameters {
  ClosedChainParameters ring{};
  double temperature = 500;          // of the particles at the start
  double scatterer_temperature = 0;  // 0: at rest
  bool zero_total_momentum = false;
  /// z of a start from the stationary measure at `temperature`, instead of the Gaussian one with
  /// particles_per_cell.
  std::optional<double> fugacity{};
  double relaxation_time = 100;
  double observation_time = 100;

  ClosedChain chain() const;
  double end_time() const { return relaxation_time + observation_time; }
  bool conserves_momentum() const;  // neither all rules do, nor scatterers of infinite mass

  /// Measure of the start with a fugacity. A particle slower than its cut moves less than a hundredth of a
  /// cell in the whole run.
  StationaryMeasure stationary_measure() const;
  double hottest() const;  // the higher one of the two temperatures

  /// Mean over replicas of the square of the total momentum [eq. 20].
  double mean_square_momentum() const;

  /// Longest time on a clock of type double that resolves a flight of the hottest particles to 5e-7 of its
  /// duration.
  double longest_clock() const;
};

/// Results depend on the age of the chain, so that the relaxation is physics. `observation` is the role of
/// the observation: the window of an average, or the last time of the output.
void declare(Options& options, ClosedParameters& parameters, Role observation);

/// Throws UsageError if options that are valid one by one exclude each other.
void validate(const ClosedParameters& parameters);

}  // namespace lorentz
