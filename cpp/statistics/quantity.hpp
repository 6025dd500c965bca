#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "statistics/description.hpp"

namespace lorentz {

/// A measured or computed quantity.
struct Quantity {
  Description what;
  std::vector<double> mean;
  std::vector<double> standard_error;      // discretisation error if computed; NaN where undefined
  std::vector<std::uint64_t> count{};      // replicas that contribute; empty if computed
  std::optional<bool> control_variates{};  // whether they were used; none if there are none
};

using Results = std::vector<Quantity>;

}  // namespace lorentz
