#pragma once

#include <span>
#include <vector>

namespace lorentz {

/// Half the sum of |r|^power C(r) over the cells of a ring at distances first <= |r| < last from the middle.
double side_moment(std::span<const double> profile, int power, double first, double last);

/// Full width of a folded profile's peak at half its height. On either side a line is fitted to the profile
/// at 0.7 to 1.3 of an expected half width from the peak; it crosses half the height. NaN if that range has
/// fewer than three cells, or if a line does not fall away from the peak.
///
/// Bias: the lines make the width of a Gaussian peak 0.8 % too large.
double half_height_width(const std::vector<double>& folded, double position, double height,
                         double expected_half_width);

}  // namespace lorentz
