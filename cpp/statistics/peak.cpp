#include "statistics/peak.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "statistics/fit.hpp"

namespace lorentz {
namespace {

struct Window {
  std::size_t first, last;
};

/// The cells within a part of the distance d, at least `least` on either side.
Window window(std::size_t d, double part, std::size_t least, std::size_t size) {
  const std::size_t half =
      std::max(least, static_cast<std::size_t>(std::lround(part * static_cast<double>(d))));
  return {d > half ? d - half : 0, std::min(d + half, size - 1)};
}

}  // namespace

std::vector<double> folded(std::span<const double> profile) {
  const std::size_t centre = profile.size() / 2;
  std::vector<double> result{profile[centre]};
  for (std::size_t d = 1; d <= centre; ++d)
    result.push_back(0.5 * (profile[centre - d] + profile[(centre + d) % profile.size()]));
  return result;
}

std::size_t highest_cell(const std::vector<double>& profile) {
  const auto mean_about = [&](std::size_t d) {
    const Window cells = window(d, 0.06, 0, profile.size());
    double sum = 0;
    for (std::size_t cell = cells.first; cell <= cells.last; ++cell) sum += profile[cell];
    return sum / static_cast<double>(cells.last - cells.first + 1);
  };
  std::size_t highest = 1;
  for (std::size_t d = 2; d < profile.size(); ++d)
    if (mean_about(d) > mean_about(highest)) highest = d;
  return highest;
}

Peak moving_peak(const std::vector<double>& profile, std::size_t about) {
  const Window cells = window(about, 0.12, 1, profile.size());
  std::vector<double> x, y;
  for (std::size_t cell = cells.first; cell <= cells.last; ++cell) {
    x.push_back(static_cast<double>(cell));
    y.push_back(profile[cell]);
  }
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const Maximum top = x.size() < 3 ? Maximum{none, none} : fit_maximum(x, y);
  return {top.position, top.height, *std::max_element(profile.begin() + 1, profile.end())};
}

}  // namespace lorentz
