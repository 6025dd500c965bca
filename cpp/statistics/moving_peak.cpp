#include "statistics/moving_peak.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
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
    const double stretch = std::pow(profile.time / last, xi);
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

PeakWindows peak_windows(const Records& records, Tally profiles, std::size_t times) {
  const auto sides = [&](TallyMeans row) { return folded_profiles(row[profiles], times); };
  PeakWindows windows;
  const std::vector<double> mean = records.mean();
  for (const std::vector<double>& side : sides(mean)) windows.push_back(peak_window(side));
  const Estimate heights = jackknife(records, [&](TallyMeans row) {
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

Axis middles(const std::vector<double>& times) {
  Axis axis{"middle", "time", "Middle of two neighbouring times", {}};
  for (std::size_t k = 0; k + 1 < times.size(); ++k) axis.values.push_back(0.5 * (times[k] + times[k + 1]));
  return axis;
}

std::vector<double> speeds(const std::vector<double>& times, const std::vector<double>& positions) {
  std::vector<double> values;
  for (std::size_t k = 0; k + 1 < times.size(); ++k)
    values.push_back((positions[k + 1] - positions[k]) / (times[k + 1] - times[k]));
  return values;
}

std::vector<double> geometric_middles(const std::vector<double>& times) {
  std::vector<double> middles;
  for (std::size_t k = 0; k + 1 < times.size(); ++k)
    middles.push_back(std::sqrt(times[k]) * std::sqrt(times[k + 1]));
  return middles;
}

std::vector<Description> MovingPeak::descriptions(const Axis& time, const std::string& units) {
  const std::vector<double> ends = octaves(time.values);
  const Axis until{"until",
                   "time",
                   "Last time of an octave, which begins where the one before it ends",
                   {ends.begin() + 1, ends.end()}};
  const Axis from{"from", "time", "First time of the fit", {time.values.begin(), time.values.end() - 1}};
  return {
      {"peak_position", "1", "Distance of the moving peak from the centre, in cells", {time}},
      {"peak", units, "Height of the moving peak, by a fit of exp(cubic) above half of it", {time}},
      {"peak_raw", units, "Largest value of the folded profile, biased upwards by the noise", {time}},
      {"peak_speed",
       "1/time",
       "Cells per time by which peak_position moves between two times",
       {middles(time.values)}},
      {"local_damping_exponent", "1", "Minus the slope of ln peak against ln t over an octave", {until}},
      {"damping_drift", "1", "Slope of local_damping_exponent against ln t"},
      {"damping_exponent_from", "1", "Minus the slope of ln peak against ln t from a time on", {from}},
      {"damping_exponent", "1", "The same over all times that have a peak"},
      {"peak_collapse", "1", "Exponent xi that makes t^xi times the profile a function of (x - peak)/t^xi"}};
}

std::vector<double> MovingPeak::values() const {
  std::vector<double> all = positions_;
  const std::vector<double> drift{exponent_drift()}, exponent{exponent_from(0)}, xi{collapse()};
  for (const std::vector<double>& each :
       {heights_, raw_heights(), speeds(), exponents_by_octave(), drift, exponents_from(), exponent, xi})
    all.insert(all.end(), each.begin(), each.end());
  return all;
}

MovingPeak::MovingPeak(std::span<const double> profiles, std::vector<double> times,
                       const PeakWindows& windows)
    : profiles_(profiles), times_(std::move(times)), sides_(folded_profiles(profiles, times_.size())) {
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
