#include "statistics/collapse.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "numerics/elementary.hpp"

namespace lorentz {
namespace {

constexpr std::size_t points = 41;               // at which the rescaled profiles are compared
constexpr double smallest = 0.1, largest = 1.5;  // range of the search for xi

/// y at x by linear interpolation; 0 outside the range of the profile.
double value_at(const Profile& profile, double x) {
  const double step = profile.x[1] - profile.x[0];
  const double place = (x - profile.x.front()) / step;
  if (place < 0 || place > static_cast<double>(profile.x.size() - 1)) return 0;
  const auto left = std::min(static_cast<std::size_t>(place), profile.x.size() - 2);
  const double part = place - static_cast<double>(left);
  return (1 - part) * profile.y[left] + part * profile.y[left + 1];
}

/// Variance of the rescaled profiles about their mean, averaged over s, relative to the mean square of that
/// mean.
double spread(std::span<const Profile> profiles, double low, double high, double xi) {
  const double last = profiles.back().time;
  std::array<double, points> sum{}, squares{};
  for (const Profile& profile : profiles) {
    const double stretch = elementary::pow(profile.time / last, xi);
    for (std::size_t i = 0; i < points; ++i) {
      const double s = low + (high - low) * static_cast<double>(i) / (points - 1);
      const double y = stretch * value_at(profile, s * stretch);
      sum[i] += y;
      squares[i] += y * y;
    }
  }
  double differences = 0, size = 0;
  for (std::size_t i = 0; i < points; ++i) {
    const double mean = sum[i] / static_cast<double>(profiles.size());
    differences += squares[i] / static_cast<double>(profiles.size()) - mean * mean;
    size += mean * mean;
  }
  return differences / size;
}

/// Minimum of a function that is unimodal on [a, b], by golden-section search, to 1e-5.
template <class Function>
double bottom(const Function& cost, double a, double b) {
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double c = b - golden * (b - a), d = a + golden * (b - a), at_c = cost(c), at_d = cost(d);
  while (b - a > 1e-5) {
    if (at_c < at_d) {
      b = std::exchange(d, c);
      at_d = at_c;
      at_c = cost(c = b - golden * (b - a));
    } else {
      a = std::exchange(c, d);
      at_c = at_d;
      at_d = cost(d = a + golden * (b - a));
    }
  }
  return 0.5 * (a + b);
}

}  // namespace

double collapse_exponent(std::span<const Profile> profiles, double low, double high) {
  if (profiles.size() < 2) throw std::invalid_argument("a collapse needs two profiles");
  // A scan brackets the minimum, because golden-section search needs a unimodal function.
  constexpr int steps = 28;
  const auto cost = [&](double xi) { return spread(profiles, low, high, xi); };
  double best = smallest, least = cost(smallest);
  for (int i = 1; i <= steps; ++i) {
    const double xi = smallest + (largest - smallest) * i / steps, here = cost(xi);
    if (!(here < least)) continue;
    best = xi;
    least = here;
  }
  const double step = (largest - smallest) / steps;
  return bottom(cost, best - step, best + step);
}

}  // namespace lorentz
