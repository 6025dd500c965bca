#include "sampling/chain_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "model/rules.hpp"
#include "program/errors.hpp"

namespace lorentz {

namespace {

/// Name of an option of a rule on the command line.
std::string flag(const RuleProperties& rule, const RuleOption& option) {
  return fmt::format("--{}-{}", rule.name, option.name);
}

}  // namespace

const RuleProperties& RuleParameters::properties() const { return rule_properties(name); }

RuleChoice RuleParameters::choice() const {
  const RuleProperties& rule = properties();
  RuleChoice choice{rule.name};
  for (const RuleOption& option : rule.options)
    choice.options.push_back(std::ranges::find(options, flag(rule, option), &Value::option)->value.value());
  return choice;
}

double ScatteringParameters::mean_scatterings() const {
  return gamma.value_or(std::numeric_limits<double>::infinity());
}

void declare(Options& options, ScatteringParameters& parameters, Range gamma_range) {
  declare_without_gamma(options, parameters);
  options.real_or_word("--gamma", parameters.gamma, gamma_range, "N", "1",
                       "Mean number of scatterings in N cells; N: every scatterer scatters");
}

void declare_without_gamma(Options& options, ScatteringParameters& parameters) {
  options.integer("--cells", parameters.cells, {1, 100'000'000}, "Number of cells N");
  options.real("--sigma", parameters.sigma, {-1, 1}, "1", "Mass ratio (M-m)/(M+m)");
  declare(options, parameters.rule);
}

void declare(Options& options, RuleParameters& parameters) {
  std::vector<std::string> names, descriptions;
  for (const RuleProperties& each : rules::all) {
    names.emplace_back(each.name);
    descriptions.push_back(fmt::format("{}: {}", each.name, each.description));
  }
  options.choice("--rule", parameters.name, names,
                 fmt::format("Collision. {}", fmt::join(descriptions, "; ")));
  for (const RuleProperties& rule : rules::all)
    for (const RuleOption& option : rule.options) parameters.options.push_back({flag(rule, option), {}});
  auto at = parameters.options.begin();
  for (const RuleProperties& rule : rules::all) {
    for (const RuleOption& option : rule.options) {
      auto& [name, value] = *at++;
      options.real_or_word(name, value, {option.low, option.high}, "none", std::string(option.units),
                           fmt::format("{}; required by --rule {}", option.description, rule.name));
    }
  }
}

void validate(const RuleParameters& parameters) {
  for (const auto& [name, value] : parameters.options) {
    const bool own = name.starts_with(fmt::format("--{}-", parameters.name));
    if (own && !value)
      throw UsageError(fmt::format("--rule {}: {} is missing. Give it a number.", parameters.name, name));
    if (!own && value)
      throw UsageError(fmt::format("{} has no effect with --rule {}. Leave it out, or choose another --rule.",
                                   name, parameters.name));
  }
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

void validate(const ScatteringParameters& parameters) {
  require_probability(parameters.gamma, parameters.cells);
  validate(parameters.rule);
  const RuleProperties& rule = parameters.rule.properties();
  if (rule.changes_neighbour && parameters.cells < 2)
    throw UsageError(fmt::format(
        "--rule {}: a single scatterer has no neighbour. Choose at least 2 --cells, or another --rule.",
        rule.name));
  if (rule.name == Printed::properties.name && std::abs(parameters.sigma) == 1)
    throw UsageError(fmt::format(
        "--sigma {}: the paper's formula has no such limit. Choose a --sigma between -1 and 1, or "
        "--rule elastic.",
        parameters.sigma));
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
          .rule = scattering.rule.choice()};
}

void declare(Options& options, ClosedChainParameters& parameters) {
  declare(options, parameters.scattering, positive);
  options.integer("--particles-per-cell", parameters.particles_per_cell, {1, 100'000'000},
                  "Number of particles per cell n");
  options.real("--cell-length", parameters.cell_length, positive, "length", "Distance between scatterers");
}

}  // namespace lorentz
