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
std::string flag(std::string_view rule, std::string_view option) {
  return fmt::format("--{}-{}", rule, option);
}

}  // namespace

const RuleProperties& RuleParameters::properties() const { return rule_properties(name); }

RuleChoice RuleParameters::choice() const {
  RuleChoice choice{properties().name};
  if (const auto values = options.find(choice.name); values != options.end())
    for (const std::optional<double>& value : values->second) choice.options.push_back(value.value());
  return choice;
}

Scatterers ScatteringParameters::scatterers(double cell_length) const {
  return {cells, cell_length, sigma, gamma.value_or(std::numeric_limits<double>::infinity()), rule.choice()};
}

void declare(Options& options, ScatteringParameters& parameters, Range gamma_range) {
  declare_without_gamma(options, parameters);
  options.real_or_word(Role::physics, "--gamma", parameters.gamma, gamma_range, "N", "1",
                       "Mean number of scatterings in N cells; N: every scatterer scatters");
}

void declare_without_gamma(Options& options, ScatteringParameters& parameters) {
  options.integer(Role::physics, "--cells", parameters.cells, {1, 100'000'000}, "Number of cells N");
  options.real(Role::physics, "--sigma", parameters.sigma, {-1, 1}, "1", "Mass ratio (M-m)/(M+m)");
  declare(options, parameters.rule);
}

void declare(Options& options, RuleParameters& parameters) {
  std::vector<std::string> names, descriptions;
  for (const RuleProperties& rule : rules::all) {
    names.emplace_back(rule.name);
    descriptions.push_back(fmt::format("{}: {}", rule.name, rule.description));
  }
  options.choice(Role::physics, "--rule", parameters.name, names,
                 fmt::format("Collision. {}", fmt::join(descriptions, "; ")));
  for (const RuleProperties& rule : rules::all) {
    std::vector<std::optional<double>>& values = parameters.options[rule.name];
    values.resize(rule.options.size());
    for (std::size_t k = 0; k < values.size(); ++k) {
      const auto& [name, units, description, low, high] = rule.options[k];
      options.of_rule(std::string(rule.name), flag(rule.name, name), values[k], {low, high},
                      std::string(units), std::string(description));
    }
  }
}

void validate(const RuleParameters& parameters) {
  for (const RuleProperties& rule : rules::all)
    for (std::size_t k = 0; k < rule.options.size(); ++k) {
      const bool chosen = rule.name == parameters.name,
                 given = parameters.options.at(rule.name)[k].has_value();
      const std::string option = flag(rule.name, rule.options[k].name);
      if (chosen && !given)
        throw UsageError(fmt::format("--rule {}: {} is missing. Give it a number.", rule.name, option));
      if (!chosen && given)
        throw UsageError(fmt::format("{} has no effect with --rule {}. Leave it out, or choose --rule {}.",
                                     option, parameters.name, rule.name));
    }
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

ClosedChain ClosedChainParameters::chain() const {
  return {scattering.scatterers(cell_length), particles_per_cell};
}

void declare(Options& options, ClosedChainParameters& parameters) {
  declare(options, parameters.scattering, positive);
  options.integer(Role::physics, "--particles-per-cell", parameters.particles_per_cell, {1, 100'000'000},
                  "Number of particles per cell n");
  options.real(Role::physics, "--cell-length", parameters.cell_length, positive, "length",
               "Distance between scatterers");
}

}  // namespace lorentz
