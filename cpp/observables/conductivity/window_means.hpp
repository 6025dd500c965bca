#pragma once

#include "observables/conductivity/ends_and_openings.hpp"

namespace lorentz {

/// Means over the window of the tallies by blocks, as tallies with one block.
Records window_means(const Records& records);

/// Means over the second half of the window minus those over the first [eq. 51]. Arrivals are those of the
/// whole window.
Records half_differences(const Records& records);

}  // namespace lorentz
