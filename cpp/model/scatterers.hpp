#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "model/rules/elastic.hpp"

namespace lorentz {

/// One fixed scatterer at the centre of every cell, and how particles collide with it. Units: m = k_B = 1; a
/// momentum is a length over a time.
struct Scatterers {
  std::uint32_t cells = 1;
  double cell_length = 1;
  double sigma = 0.5;                                      // (M-m)/(M+m)
  double gamma = std::numeric_limits<double>::infinity();  // mean number of scatterings in N cells
  RuleChoice rule{Elastic::properties.name};               // of collisions

  bool deterministic() const { return gamma >= cells; }  // a particle scatters at every scatterer
  double scattering_probability() const { return std::min(1., gamma / cells); }  // at one scatterer
  /// Mean distance between two scatterings, at most the length of the chain.
  double free_path() const { return cell_length * (cells / std::clamp(gamma, 1., 1. * cells)); }
};

}  // namespace lorentz
