#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace lorentz {

/// A profile on a ring as a function of the distance d = 0, 1, ... from the central cell: mean of both sides.
std::vector<double> folded(std::span<const double> profile);

struct Peak {
  double position;    // in cells
  double height;      // of the parabola
  double raw_height;  // largest value away from the centre: biased upwards by the noise
};

/// The cell away from the centre where the running mean of a folded profile is largest. The mean runs over
/// 6 % of the distance on either side.
std::size_t highest_cell(const std::vector<double>& profile);

/// The top of a parabola fitted to the cells within 12 % of the distance of the given cell, and within those
/// cells: the profiles that spread from a pulse have fallen by about a fifth there. The cell is an argument
/// because it has to be chosen once, from the mean over all replicas: chosen anew for every jackknife sample
/// it would jump, and the errors with it.
Peak moving_peak(const std::vector<double>& profile, std::size_t about);

}  // namespace lorentz
