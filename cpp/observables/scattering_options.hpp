#pragma once

#include <cstdint>

#include "program/options.hpp"

namespace lorentz {

/// --cells, --sigma and --gamma of any chain; gamma is infinite for the word N.
void add_scattering_options(Options& options, std::uint32_t& cells, double& sigma, double& gamma,
                            Range<double> gamma_range);

}  // namespace lorentz
