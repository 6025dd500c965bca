#pragma once

#include <span>
#include <vector>

namespace lorentz {

/// A profile y(x) at one time; x equally spaced and ascending.
struct Profile {
  double time;
  std::vector<double> x, y;
};

/// Exponent xi for which y = t^-xi f(x/t^xi) describes all profiles best [eq. 46, 48]. The profiles rescaled
/// to the last time, s = x (t_last/t)^xi and Y = y (t/t_last)^xi, have the least variance about their mean,
/// averaged over s in [low, high] and relative to the mean square of their mean. The search covers 0.1 <= xi
/// <= 1.5. Throws std::invalid_argument for fewer than two profiles.
double collapse_exponent(std::span<const Profile> profiles, double low, double high);

}  // namespace lorentz
