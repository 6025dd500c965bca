#pragma once

#include <string>
#include <vector>

#include "statistics/estimator.hpp"
#include "statistics/moving_peak.hpp"

namespace lorentz {

/// Adds what is measured of a moving peak at these times: its position and height, its speed and local
/// damping exponent between two times, damping exponents over ranges of times, and its collapse exponent.
/// `units` are those of the profile.
void add_peak_quantities(Formulas<MovingPeak>& formulas, const Axis& time, const std::string& units);

/// Local exponents are between neighbouring times; this axis has their geometric middles.
Axis geometric_middles(const std::vector<double>& times);

}  // namespace lorentz
