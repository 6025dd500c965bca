#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/closed_chain.hpp"
#include "model/collision_rule.hpp"
#include "model/rules/elastic.hpp"
#include "program/options.hpp"
#include "sampling/reservoir_parameters.hpp"

namespace lorentz {

/// A collision rule, and the options of all rules.
struct RuleParameters {
  std::string name{Elastic::properties.name};
  /// Values of the options of every rule, by its name and in their order; none: not given.
  std::map<std::string_view, std::vector<std::optional<double>>> options{};

  const RuleProperties& properties() const;
  RuleChoice choice() const;
};

/// Parameters that closed and open chains have in common.
struct ScatteringParameters {
  std::uint32_t cells = 0;
  double sigma = 0.5;             // (M-m)/(M+m)
  std::optional<double> gamma{};  // mean number of scatterings in N cells; none: N, every scatterer scatters
  RuleParameters rule{};          // of collisions

  Scatterers scatterers(double cell_length) const;
};

/// Declares --cells, --sigma, --gamma and --rule.
void declare(Options& options, ScatteringParameters& parameters, Range gamma_range);
void declare_without_gamma(Options& options, ScatteringParameters& parameters);

/// Declares --rule and the options of all rules.
void declare(Options& options, RuleParameters& parameters);

/// Throws UsageError unless the options of the rule, and of no other rule, are given.
void validate(const RuleParameters& parameters);

/// Throws UsageError if a replica would have more than 1e9 particles, which `options` determine.
void require_memory(double particles, const std::string& options);

/// Throws UsageError unless a clock that runs until `end` resolves 1e-4 of a time. `options` determine the
/// two.
void require_resolved(double time, double end, const std::string& options);

/// Throws UsageError if options that are valid one by one exclude each other.
void validate(const ScatteringParameters& parameters);

/// Parameters of a closed chain.
struct ClosedChainParameters {
  ScatteringParameters scattering{.cells = 11};
  std::uint32_t particles_per_cell = 20;
  double cell_length = 1;

  ClosedChain chain() const;
};

/// Declares --cells, --sigma, --gamma, --rule, --particles-per-cell and --cell-length.
void declare(Options& options, ClosedChainParameters& parameters);

}  // namespace lorentz
