#include "observables/energy_pulse/moving_peak.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "statistics/fit.hpp"
#include "statistics/group.hpp"

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

/// Middles of neighbouring times, where speeds between them belong.
Axis middles(const std::vector<double>& times) {
  Axis axis{"middle", "time", "Middle of two neighbouring times", {}};
  for (std::size_t k = 0; k + 1 < times.size(); ++k) axis.values.push_back(0.5 * (times[k] + times[k + 1]));
  return axis;
}

}  // namespace

PeakWindows peak_windows(const Records& records, Tally profiles, std::size_t times) {
  const auto sides = [&](TallyMeans row) { return folded_profiles(row[profiles], times); };
  PeakWindows windows;
  const std::vector<double> mean = records.mean();
  for (const std::vector<double>& side : sides(mean)) windows.push_back(peak_window(side));
  const Estimates heights = jackknife(records, [&](TallyMeans row) {
    const std::vector<std::vector<double>> folded = sides(row);
    std::vector<double> values;
    for (std::size_t k = 0; k < times; ++k) values.push_back(peak_in(windows[k], folded[k]).height);
    return values;
  });
  const std::vector<double>& defined = records.size() > 1 ? heights.standard_error : heights.mean;
  for (std::size_t k = 0; k < times; ++k)
    if (std::isnan(defined[k])) windows[k].reset();
  return windows;
}

std::vector<double> octaves(const std::vector<double>& times) {
  const double first = std::log(times.front()), span = std::log(times.back()) - first;
  const double parts = std::max(1.0, std::round(span / std::numbers::ln2));
  std::vector<double> ends{times.front()};
  for (int k = 1; k <= parts; ++k) {
    const double wanted = first + k * span / parts;
    const double nearest =
        *std::ranges::min_element(times, {}, [&](double time) { return std::abs(std::log(time) - wanted); });
    if (nearest > ends.back()) ends.push_back(nearest);
  }
  return ends;
}

std::vector<MovingPeak::Measured> MovingPeak::quantities(const Axis& time, const Axis& distance,
                                                         const std::string& units) {
  const std::vector<double> ends = octaves(time.values);
  const Axis until{"until",
                   "time",
                   "Last time of an octave, which begins where the one before it ends",
                   {ends.begin() + 1, ends.end()}};
  const Axis from{"from", "time", "First time of the fit", {time.values.begin(), time.values.end() - 1}};
  const Axis middle = middles(time.values);
  return {
      {{"peak_position", "1", "Distance of the moving peak from the centre, in cells", {time}},
       &MovingPeak::positions},
      {{"peak", units, "Height of the moving peak, by a fit of exp(cubic) above half of it", {time}},
       &MovingPeak::heights},
      {{"peak_speed", "1/time", "Cells per time by which peak_position moves between two times", {middle}},
       &MovingPeak::speeds},
      {{"local_damping_exponent", "1", "Minus the slope of ln peak against ln t over an octave", {until}},
       &MovingPeak::exponents_by_octave},
      {{"damping_exponent_from", "1", "Minus the slope of ln peak against ln t from a time on", {from}},
       &MovingPeak::exponents_from},
      {{"damping_exponent", "1", "The same over all times that have a peak"}, &MovingPeak::exponent},
      {{"centre_share", "1", "Part of the injected energy in the central five cells", {time}},
       &MovingPeak::centre_shares},
      {{"odd_part", units, "Half of right minus left side: 0 by mirror symmetry", {time, distance}},
       &MovingPeak::odd_parts}};
}

MovingPeak::MovingPeak(std::span<const double> profiles, std::vector<double> times, double total,
                       const PeakWindows& windows)
    : profiles_(profiles),
      times_(std::move(times)),
      total_(total),
      sides_(folded_profiles(profiles, times_.size())) {
  for (std::size_t k = 0; k < times_.size(); ++k) {
    const Peak peak = peak_in(windows[k], sides_[k]);
    positions_.push_back(peak.position);
    heights_.push_back(peak.height);
  }
}

std::vector<double> MovingPeak::speeds() const {
  std::vector<double> values;
  for (std::size_t k = 0; k + 1 < times_.size(); ++k)
    values.push_back((positions_[k + 1] - positions_[k]) / (times_[k + 1] - times_[k]));
  return values;
}

std::vector<double> MovingPeak::centre_shares() const {
  std::vector<double> values;
  for (const std::vector<double>& side : sides_)
    values.push_back((side[0] + 2 * (side[1] + side[2])) / total_);
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

std::vector<double> MovingPeak::exponents_from() const {
  std::vector<double> values;
  for (std::size_t k = 0; k + 1 < times_.size(); ++k)
    values.push_back(std::isnan(heights_[k]) ? none : exponent_from(k));
  return values;
}

double MovingPeak::exponent_from(std::size_t first) const {
  return exponent_between(times_[first], times_.back(), 1);
}

double MovingPeak::exponent_between(double begin, double end, double least_ratio) const {
  std::vector<double> times, heights;
  for (std::size_t k = 0; k < times_.size(); ++k) {
    if (std::isnan(heights_[k]) || times_[k] < begin || times_[k] > end) continue;
    times.push_back(times_[k]);
    heights.push_back(heights_[k]);
  }
  if (times.size() < 2 || times.back() < least_ratio * times.front()) return none;
  return -fit_power(times, heights, times.front(), times.back());
}

std::vector<double> MovingPeak::exponents_by_octave() const {
  const std::vector<double> ends = octaves(times_);
  std::vector<double> values;
  for (std::size_t k = 0; k + 1 < ends.size(); ++k)
    values.push_back(exponent_between(ends[k], ends[k + 1], std::sqrt(ends[k + 1] / ends[k])));
  return values;
}

}  // namespace lorentz
