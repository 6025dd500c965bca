#include "statistics/moving_peak.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "numerics/elementary.hpp"
#include "statistics/collapse.hpp"
#include "statistics/fit.hpp"
#include "statistics/jackknife.hpp"

namespace lorentz {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Folded profile at every time.
std::vector<std::vector<double>> folded_profiles(std::span<const double> profiles, std::size_t times) {
  const std::size_t cells = profiles.size() / times;
  std::vector<std::vector<double>> result;
  for (std::size_t k = 0; k < times; ++k) result.push_back(folded(profiles.subspan(k * cells, cells)));
  return result;
}

Peak peak_in(const std::optional<PeakWindow>& window, const std::vector<double>& profile) {
  return window ? fit_peak(profile, *window) : Peak{none, none};
}

}  // namespace

PeakWindows peak_windows(const Records& records, const Columns& profile, std::size_t times) {
  const auto sides = [&](std::span<const double> row) {
    return folded_profiles(row.subspan(profile.front(), profile.size()), times);
  };
  PeakWindows windows;
  for (const std::vector<double>& side : sides(records.mean())) windows.push_back(peak_window(side));
  const Estimate heights = jackknife(records, [&](std::span<const double> row) {
    const std::vector<std::vector<double>> folded = sides(row);
    std::vector<double> values;
    for (std::size_t k = 0; k < times; ++k) values.push_back(peak_in(windows[k], folded[k]).height);
    return values;
  });
  const std::vector<double>& known = records.size() > 1 ? heights.standard_error : heights.mean;
  for (std::size_t k = 0; k < times; ++k)
    if (std::isnan(known[k])) windows[k].reset();
  return windows;
}

std::vector<double> octaves(const std::vector<double>& times) {
  const double first = elementary::log(times.front()), span = elementary::log(times.back()) - first;
  const double parts = std::max(1.0, std::round(span / std::numbers::ln2));
  std::vector<double> ends{times.front()};
  for (int k = 1; k <= parts; ++k) {
    const double wanted = first + k * span / parts;
    const double nearest = *std::ranges::min_element(
        times, {}, [&](double time) { return std::abs(elementary::log(time) - wanted); });
    if (nearest > ends.back()) ends.push_back(nearest);
  }
  return ends;
}

std::vector<double> geometric_middles(const std::vector<double>& times) {
  std::vector<double> middles;
  for (std::size_t k = 0; k + 1 < times.size(); ++k)
    middles.push_back(std::sqrt(times[k]) * std::sqrt(times[k + 1]));
  return middles;
}

MovingPeak::MovingPeak(std::span<const double> profiles, RecordView mean, std::vector<double> times,
                       const PeakWindows& windows)
    : profiles_(profiles),
      mean_(mean),
      times_(std::move(times)),
      sides_(folded_profiles(profiles, times_.size())) {
  for (std::size_t k = 0; k < times_.size(); ++k) {
    const Peak peak = peak_in(windows[k], sides_[k]);
    positions_.push_back(peak.position);
    heights_.push_back(peak.height);
  }
}

std::vector<double> MovingPeak::raw_heights() const {
  std::vector<double> values;
  for (const std::vector<double>& side : sides_) values.push_back(highest_value(side));
  return values;
}

std::vector<double> MovingPeak::centre_shares(double total) const {
  std::vector<double> values;
  for (const std::vector<double>& side : sides_)
    values.push_back((side[0] + 2 * (side[1] + side[2])) / total);
  return values;
}

std::vector<double> MovingPeak::odd_parts() const {
  const std::size_t cells = profiles_.size() / times_.size();
  std::vector<double> values;
  for (std::size_t k = 0; k < times_.size(); ++k) {
    const std::vector<double> odd = odd_part(profiles_.subspan(k * cells, cells));
    values.insert(values.end(), odd.begin(), odd.end());
  }
  return values;
}

std::vector<double> MovingPeak::speeds() const {
  std::vector<double> values;
  for (std::size_t k = 0; k + 1 < times_.size(); ++k)
    values.push_back((positions_[k + 1] - positions_[k]) / (times_[k + 1] - times_[k]));
  return values;
}

std::vector<double> MovingPeak::exponents_from() const {
  std::vector<double> values;
  for (std::size_t k = 0; k + 1 < times_.size(); ++k)
    values.push_back(std::isnan(heights_[k]) ? none : exponent_from(k));
  return values;
}

double MovingPeak::exponent_from(std::size_t first) const {
  std::vector<double> times, heights;
  for (std::size_t k = first; k < times_.size(); ++k) {
    if (std::isnan(heights_[k])) continue;
    times.push_back(times_[k]);
    heights.push_back(heights_[k]);
  }
  return times.size() < 2 ? none : -fit_power(times, heights, times.front(), times.back());
}

std::vector<double> MovingPeak::exponents_by_octave() const {
  const std::vector<double> ends = octaves(times_);
  std::vector<double> values;
  for (std::size_t k = 0; k + 1 < ends.size(); ++k)
    values.push_back(-fit_power(times_, heights_, ends[k], ends[k + 1]));
  return values;
}

double MovingPeak::exponent_drift() const {
  const std::vector<double> middles = geometric_middles(octaves(times_)), exponents = exponents_by_octave();
  std::vector<double> times, known;
  for (std::size_t k = 0; k < exponents.size(); ++k) {
    if (std::isnan(exponents[k])) continue;
    times.push_back(middles[k]);
    known.push_back(exponents[k]);
  }
  return known.size() < 2 ? none : fit_logarithm(times, known, times.front(), times.back());
}

double MovingPeak::collapse() const {
  std::vector<Profile> moving;
  double reach = 0;
  for (std::size_t k = 0; k < times_.size(); ++k) {
    if (std::isnan(positions_[k])) continue;
    Profile profile{times_[k], {}, sides_[k]};
    for (std::size_t d = 0; d < sides_[k].size(); ++d)
      profile.x.push_back(static_cast<double>(d) - positions_[k]);
    moving.push_back(std::move(profile));
    reach = 0.25 * positions_[k];
  }
  return moving.size() < 2 ? none : collapse_exponent(moving, -reach, reach);
}

}  // namespace lorentz
