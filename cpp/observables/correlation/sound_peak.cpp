#include "observables/correlation/sound_peak.hpp"

#include <cmath>
#include <cstddef>
#include <limits>

#include "statistics/fit.hpp"

namespace lorentz {

double side_moment(std::span<const double> profile, int power, double first, double last) {
  double sum = 0;
  for (std::size_t cell = 0; cell < profile.size(); ++cell) {
    const double distance = std::abs(static_cast<double>(cell) - static_cast<double>(profile.size() / 2));
    if (distance >= first && distance < last) sum += 0.5 * std::pow(distance, power) * profile[cell];
  }
  return sum;
}

double half_height_width(const std::vector<double>& folded, double position, double height,
                         double expected_half_width) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  double width = 0;
  for (const double side : {-1.0, 1.0}) {
    std::vector<double> distance, y;
    for (std::size_t cell = 0; cell < folded.size(); ++cell) {
      const double from_peak = side * (static_cast<double>(cell) - position) / expected_half_width;
      if (from_peak < 0.7 || from_peak > 1.3) continue;
      distance.push_back(from_peak * expected_half_width);
      y.push_back(folded[cell]);
    }
    if (y.size() < 3) return none;
    const Line line = fit_line(distance, y);
    if (!(line.slope < 0)) return none;
    width += (0.5 * height - line.intercept) / line.slope;
  }
  return width;
}

}  // namespace lorentz
