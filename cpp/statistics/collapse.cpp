#include "statistics/collapse.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace lorentz {
namespace {

constexpr int points = 41;  // at which the rescaled profiles are compared
constexpr double smallest = 0.1, largest = 1.5;

/// Linear interpolation; 0 outside.
double value_at(const Profile& profile, double x) {
  const double step = profile.x[1] - profile.x[0];
  const double place = (x - profile.x.front()) / step;
  if (place < 0 || place > static_cast<double>(profile.x.size() - 1)) return 0;
  const auto left = std::min(static_cast<std::size_t>(place), profile.x.size() - 2);
  const double part = place - static_cast<double>(left);
  return (1 - part) * profile.y[left] + part * profile.y[left + 1];
}

/// Mean square spread of the rescaled profiles over the mean square of their mean.
double spread(std::span<const Profile> profiles, double low, double high, double xi) {
  const double last = profiles.back().time;
  double differences = 0, size = 0;
  for (int i = 0; i < points; ++i) {
    const double s = low + (high - low) * i / (points - 1);
    double sum = 0, squares = 0;
    for (const Profile& profile : profiles) {
      const double stretch = std::pow(profile.time / last, xi);
      const double y = stretch * value_at(profile, s * stretch);
      sum += y;
      squares += y * y;
    }
    const double mean = sum / static_cast<double>(profiles.size());
    differences += squares / static_cast<double>(profiles.size()) - mean * mean;
    size += mean * mean;
  }
  return differences / size;
}

}  // namespace

double collapse_exponent(std::span<const Profile> profiles, double low, double high) {
  if (profiles.size() < 2) throw std::invalid_argument("a collapse needs two profiles");
  // A scan finds the valley, the golden section its bottom.
  constexpr int steps = 28;
  const auto cost = [&](double xi) { return spread(profiles, low, high, xi); };
  double best = smallest;
  for (int i = 1; i <= steps; ++i) {
    const double xi = smallest + (largest - smallest) * i / steps;
    if (cost(xi) < cost(best)) best = xi;
  }
  double a = best - (largest - smallest) / steps, b = best + (largest - smallest) / steps;
  const double golden = (std::sqrt(5.0) - 1) / 2;
  while (b - a > 1e-5) {
    const double c = b - golden * (b - a), d = a + golden * (b - a);
    (cost(c) < cost(d) ? b : a) = cost(c) < cost(d) ? d : c;
  }
  return 0.5 * (a + b);
}

}  // namespace lorentz
