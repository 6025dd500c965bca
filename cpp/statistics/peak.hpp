#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace lorentz {

/// A profile on a ring as a function of the distance d = 0, 1, ... from the central cell: mean of both sides.
std::vector<double> folded(std::span<const double> profile);

/// Half the right side minus the left side at the distances d = 1, 2, ... less than half the ring: 0 in the
/// mean by mirror symmetry.
std::vector<double> odd_part(std::span<const double> profile);

/// Largest value away from the centre. Biased upwards by the noise, downwards by the distance between cells.
double highest_value(const std::vector<double>& profile);

/// Distances from the centre, both real.
struct PeakWindow {
  double middle, half_width;  // in cells
};

/// Where the running mean of a folded profile is above half its maximum away from the centre, and at least
/// five cells. The mean runs over 6 % of the distance on either side; the ends are interpolated linearly.
/// None if the profile does not fall below the half on both sides of the maximum: no peak has left the
/// centre, or it has come to the far side of the ring.
///
/// A window is found once, from the mean over all replicas: found anew for every jackknife sample, cells
/// would enter and leave it.
std::optional<PeakWindow> peak_window(const std::vector<double>& profile);

struct Peak {
  double position;  // distance in cells
  double height;
};

/// Top of exp(cubic), fitted in the window by least squares with the weights 1 - ((d - middle)/half_width)^2,
/// which let no cell enter at once. NaN if the fit has no maximum in the window.
///
/// Bias against exact profiles, averaged over cells (tests/cpp/peak_test.cpp). Height: Gaussian peaks of 1 to
/// 7 cells standard deviation 0.1 %; sech^2 of the same widths 5 % at 1 cell, 2 % at 1.5, 1.2 % above; the
/// energy of freely flying particles, x^2 exp(-x^2/2s^2), 3 % at s = 2 cells, 0.6 % from 3 on. Position: 5 %
/// of the width. Noise adds nothing to first order, unlike to a fit of logarithms.
Peak fit_peak(const std::vector<double>& profile, const PeakWindow& window);

}  // namespace lorentz
