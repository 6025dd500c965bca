#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "program/errors.hpp"

namespace lorentz {

/// Ascending times in units of the first, the interval of a record. Throws UsageError unless they are whole
/// multiples of it.
inline std::vector<std::size_t> lags(const std::vector<double>& times) {
  std::vector<std::size_t> lags;
  for (const double time : times) {
    const double lag = time / times.front();
    if (lag > 1e6 || std::abs(lag - std::round(lag)) > 1e-6 * lag)
      throw UsageError(
          "--times: every time must be a whole multiple of the first, which is the interval of the record, "
          "and at most 1e6 times it. Choose others.");
    lags.push_back(static_cast<std::size_t>(std::lround(lag)));
  }
  return lags;
}

}  // namespace lorentz
