#pragma once

#include <numeric>

#include "statistics/control_variates.hpp"

namespace support {

/// The columns first, ..., first + count - 1.
inline lorentz::Columns columns(std::size_t first, std::size_t count) {
  lorentz::Columns result(count);
  std::iota(result.begin(), result.end(), first);
  return result;
}

/// Regression of all columns except the last `controls` ones on these.
inline lorentz::Regression on_last(const lorentz::Records& records, std::size_t controls) {
  const std::size_t measured = records.width() - controls;
  return {columns(0, measured), columns(measured, controls)};
}

}  // namespace support
