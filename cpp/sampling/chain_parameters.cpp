#include "sampling/chain_parameters.hpp"

#include <fmt/format.h>

#include <limits>
#include <vector>

#include "model/rules.hpp"
#include "program/errors.hpp"

namespace lorentz {

double ScatteringParameters::mean_scatterings() const {
  return gamma.value_or(std::numeric_limits<double>::infinity());
}

void declare(Options& options, ScatteringParameters& parameters, Range gamma_range) {
  options.integer("--cells", parameters.cells, {1, 100'000'000}, "Number of cells N");
  options.real("--sigma", parameters.sigma, {-1, 1}, "1", "Mass ratio (M-m)/(M+m)");
  options.real_or_word("--gamma", parameters.gamma, gamma_range, "N", "1",
                       "Mean number of scatterings in N cells; N: every scatterer scatters");
  declare_rule(options, parameters.rule);
}

void declare_rule(Options& options, std::string& rule) {
  std::vector<std::string> names, descriptions;
  for (const RuleProperties& each : rules::all) {
    names.emplace_back(each.name);
    descriptions.push_back(fmt::format("{}: {}", each.name, each.description));
  }
  options.choice("--rule", rule, names, fmt::format("Collision. {}", fmt::join(descriptions, "; ")));
}

void require_probability(std::optional<double> gamma, std::uint32_t cells) {
  if (gamma && *gamma > cells)
    throw UsageError(
        "--gamma exceeds --cells: gamma/N is a probability. Choose more cells or a smaller gamma.");
}

void require_memory(double particles, const std::string& options) {
  constexpr double most = 1e9;
  if (particles > most)
    throw UsageError(
        fmt::format("{}: a replica would have {:.2g} particles, more than {:g}. Choose a smaller system.",
                    options, particles, most));
}

void require_resolved(double time, double end, const std::string& options) {
  constexpr double most = 1e12;
  if (!(end / time <= most))
    throw UsageError(
        fmt::format("{}: the run is {:.2g} times as long as the shortest time that it must resolve, more "
                    "than {:g}, so that numbers would lose precision. Choose a shorter run.",
                    options, end / time, most));
}

void declare(Options& options, Reservoir& left, Reservoir& right) {
  options.real("--nu-left", left.rate, non_negative, "1/time",
               "Particles injected at the left per unit time");
  options.real("--nu-right", right.rate, non_negative, "1/time",
               "Particles injected at the right per unit time");
  options.real("--temperature-left", left.temperature, positive, "temperature",
               "Temperature of the left reservoir");
  options.real("--temperature-right", right.temperature, positive, "temperature",
               "Temperature of the right reservoir");
}

ClosedChain ClosedChainParameters::chain() const {
  return {.cells = scattering.cells,
          .particles_per_cell = particles_per_cell,
          .cell_length = cell_length,
          .sigma = scattering.sigma,
          .gamma = scattering.mean_scatterings(),
          .rule = rule_properties(scattering.rule).name};
}

void declare(Options& options, ClosedChainParameters& parameters) {
  declare(options, parameters.scattering, positive);
  options.integer("--particles-per-cell", parameters.particles_per_cell, {1, 100'000'000},
                  "Number of particles per cell n");
  options.real("--cell-length", parameters.cell_length, positive, "length", "Distance between scatterers");
}

}  // namespace lorentz
