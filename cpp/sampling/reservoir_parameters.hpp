#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <optional>

#include "model/reservoir.hpp"
#include "program/errors.hpp"
#include "program/options.hpp"

namespace lorentz {

/// Declares --nu-left, --nu-right, --temperature-left and --temperature-right.
inline void declare(Options& options, Reservoir& left, Reservoir& right) {
  options.real(Role::physics, "--nu-left", left.rate, non_negative, "1/time",
               "Particles injected at the left per unit time");
  options.real(Role::physics, "--nu-right", right.rate, non_negative, "1/time",
               "Particles injected at the right per unit time");
  options.real(Role::physics, "--temperature-left", left.temperature, positive, "temperature",
               "Temperature of the left reservoir");
  options.real(Role::physics, "--temperature-right", right.temperature, positive, "temperature",
               "Temperature of the right reservoir");
}

/// Throws UsageError if particles would have to scatter more than once per cell; gamma none: N.
inline void require_probability(std::optional<double> gamma, std::uint32_t cells) {
  if (gamma && *gamma > cells)
    throw UsageError(fmt::format(
        "--gamma {} exceeds --cells {}: gamma/N is a probability. Choose more cells or a smaller gamma.",
        *gamma, cells));
}

}  // namespace lorentz
