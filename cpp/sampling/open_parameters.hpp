#pragma once

#include <optional>
#include <string>

#include "engine/path.hpp"
#include "model/open_chain.hpp"
#include "model/phase_point.hpp"
#include "numerics/stream_key.hpp"
#include "program/options.hpp"
#include "sampling/chain_parameters.hpp"

namespace lorentz {

/// Parameters of an open chain, its reservoirs and its initial state. Defaults: figure 2 of the paper.
struct OpenParameters {
  ScatteringParameters scattering{.cells = 30};
  std::optional<double> cell_length{};  // none: 1/N
  Reservoir left = default_left, right = default_right;
  std::string start = "warm";

  OpenChain chain() const;

  /// State of a replica at time 0; where it has particles, the state after they have entered for the time
  /// `age` [eq. 11].
  PhasePoint start_point(double age, const StreamKey& key) const;
};

/// Parameters of a measurement in the stationary state.
struct StationaryParameters : OpenParameters {
  double relaxation_time = 100;
  double observation_time = 1000;

  Window window() const { return {relaxation_time, relaxation_time + observation_time}; }
};

/// `start` is the role of the initial state, on which stationary results do not depend.
void declare(Options& options, OpenParameters& parameters, Role start);
void declare(Options& options, StationaryParameters& parameters);

/// Throw UsageError if options that are valid one by one exclude each other, for a run until `end`, which the
/// options `times` determine.
void validate(const OpenParameters& parameters, double end, const std::string& times);
void validate(const StationaryParameters& parameters);

}  // namespace lorentz
