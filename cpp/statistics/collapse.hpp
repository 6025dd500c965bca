#pragma once

#include <span>
#include <vector>

namespace lorentz {

/// A profile y(x) at one time; x equally spaced and ascending.
struct Profile {
  double time;
  std::vector<double> x, y;
};

/// The xi for which y = t^-xi f(x / t^xi) describes all profiles best: rescaled to the last time,
/// s = x (t_last/t)^xi and Y = y (t/t_last)^xi, they differ least, in the mean square over s in [low, high],
/// from their mean. Searched in [0.1, 1.5]; throws std::invalid_argument with fewer than two profiles.
double collapse_exponent(std::span<const Profile> profiles, double low, double high);

}  // namespace lorentz
