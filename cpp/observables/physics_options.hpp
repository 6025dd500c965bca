#pragma once

#include <cstdint>

#include "model/reservoir.hpp"
#include "program/options.hpp"

namespace lorentz {

/// --cells, --sigma and --gamma of any chain; gamma is infinite for the word N.
void add_scattering_options(Options& options, std::uint32_t& cells, double& sigma, double& gamma,
                            Range<double> gamma_range);

/// --nu-left, --nu-right, --temperature-left and --temperature-right.
void add_reservoir_options(Options& options, Reservoir& left, Reservoir& right);

}  // namespace lorentz
