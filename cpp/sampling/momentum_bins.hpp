#pragma once

#include <fmt/format.h>

#include <cstdint>

#include "program/errors.hpp"
#include "program/options.hpp"
#include "statistics/histogram.hpp"
#include "statistics/tally.hpp"

namespace lorentz {

/// Parameters of equal bins of momentum with an edge at 0.
struct MomentumBinParameters {
  std::uint32_t count = 100;
  double max = 60;

  Bins bins() const { return {count, max}; }
};

/// Declares --momentum-bins and --momentum-max.
inline void declare(Options& options, MomentumBinParameters& parameters) {
  options.integer(Role::output, "--momentum-bins", parameters.count, {2, 100'000},
                  "Number of bins of momentum, even");
  options.real(Role::output, "--momentum-max", parameters.max, positive, "momentum",
               "The bins span from minus this momentum to plus it");
}

/// Throws UsageError if the number of bins is odd, as no edge would lie at 0.
inline void validate(const MomentumBinParameters& parameters) {
  if (parameters.count % 2 != 0)
    throw UsageError(fmt::format(
        "--momentum-bins {} is odd: no edge would lie at 0, where the flux jumps. Choose an even number.",
        parameters.count));
}

inline Axis momentum_axis(const Bins& bins) {
  return {"momentum", "momentum", "Middle of the bin", bins.middles()};
}

}  // namespace lorentz
