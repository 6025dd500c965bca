#pragma once

#include <string>

#include "statistics/estimator.hpp"
#include "statistics/moving_peak.hpp"

namespace lorentz {

/// Adds what is measured of a moving peak at these times: its position and height, its speed
/// between two times, damping exponents over octaves and other ranges of times, and its collapse exponent.
/// `units` are those of the profile.
void add_peak_quantities(Formulas<MovingPeak>& formulas, const Axis& time, const std::string& units);

}  // namespace lorentz
