#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "observables/energy_pulse/peak.hpp"
#include "statistics/tally.hpp"

namespace lorentz {

/// Window of the peak fit at every time; empty without a peak.
using PeakWindows = std::vector<std::optional<PeakWindow>>;

/// Windows of the mean profile over all replicas. A window is dropped if the fit fails for that mean or for a
/// leave-one-out mean, whose jackknife error would be NaN. `profiles`: on the ring, [time, cell].
PeakWindows peak_windows(const Records& records, Tally profiles, std::size_t times);

/// Ends of the octaves of ascending times > 0: the range is divided evenly in ln t into as many parts as it
/// has doublings (at least one), and the ends are the nearest of the times. The first is times.front().
std::vector<double> octaves(const std::vector<double>& times);

/// Moving peak of a mean profile that spreads on a ring. Arrays have one element per time, per pair of
/// neighbouring times or per octave; NaN without a peak.
class MovingPeak {
 public:
  /// profiles: [time, cell], part of the mean record; total: sum of a profile.
  MovingPeak(std::span<const double> profiles, std::vector<double> times, double total,
             const PeakWindows& windows);

  /// A quantity and the function of the peak that gives its values.
  struct Measured {
    Description what;
    std::vector<double> (MovingPeak::*values)() const;
  };
  /// All that is measured; `units` are those of the profile.
  static std::vector<Measured> quantities(const Axis& time, const Axis& distance, const std::string& units);

  std::vector<double> positions() const { return positions_; }
  std::vector<double> heights() const { return heights_; }
  std::vector<double> speeds() const;                                  // between neighbouring times
  std::vector<double> centre_shares() const;                           // part in the five central cells
  std::vector<double> odd_parts() const;                               // [time, distance]
  std::vector<double> exponent() const { return {exponent_from(0)}; }  // a single number
  std::vector<double> exponents_from() const;                          // fits from every time but the last on

  /// Fits over octaves. Between neighbouring times, heights that differ by the bias of the peak's fit, 1.3 %
  /// at the first times, would change the exponent by 0.06; over an octave of four times by less than 0.02.
  /// Times without a peak are left out; NaN if the others cover less than half of the octave.
  std::vector<double> exponents_by_octave() const;

 private:
  /// Minus the slope of ln height against ln t over the times with a peak, from time number `first` on.
  double exponent_from(std::size_t first) const;
  /// The same over the times with a peak in [begin, end]; NaN unless the last is `least_ratio` times the
  /// first.
  double exponent_between(double begin, double end, double least_ratio) const;

  std::span<const double> profiles_;
  std::vector<double> times_;
  double total_;
  std::vector<std::vector<double>> sides_;  // folded profile at every time
  std::vector<double> positions_, heights_;
};

}  // namespace lorentz
