#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/path.hpp"
#include "sampling/momentum_bins.hpp"
#include "statistics/histogram.hpp"
#include "statistics/log_grid.hpp"
#include "statistics/tally.hpp"

namespace lorentz {

/// Times and momentum bins at which the particles inside an open chain are counted.
struct CensusGrid {
  static constexpr std::size_t points_per_decade = 8;

  std::vector<double> times;  // of the momentum distributions
  Bins bins;
  /// Logarithmic bins of |p|, from a tenth of the free path over the last time on, below the front [eq. 24].
  LogGrid speeds;
  std::vector<double> number_times;  // three decades, or more where the first of `times` is earlier
  double free_path;

  CensusGrid(const std::vector<double>& snapshot_times, const Bins& linear, double path)
      : times(snapshot_times),
        bins(linear),
        speeds(0.1 * path / times.back(),
               std::max(1., std::log10(10 * bins.edge(bins.count()) * times.back() / path)),
               points_per_decade),
        free_path(path) {
    constexpr double points = points_per_decade;
    const double steps =
        std::ceil(points * std::log10(times.back() / times.front()) - 1e-9);  // rounding adds none
    const double decades = std::max(3., steps / points);
    number_times = LogGrid(times.back() * std::pow(10, -decades), decades, points_per_decade).points();
    number_times.back() = times.back();
  }
};

/// Tallies of the particles inside an open chain at given times [eq. 23].
struct CensusTallies : TallySchema {
  Axis time, p, speed, number_time;
  Tally momentum =
      tally("momentum", {time, p}, "momentum", "Sum of |p| over the particles in a linear bin of p");
  Tally by_speed = tally("by_speed", {time, speed}, "1", "Particles in a logarithmic bin of |p|");
  Tally slower = tally("slower", {time}, "1", "Particles slower than these bins");
  Tally number = tally("total_number", {number_time}, "1", "Particles inside");

  explicit CensusTallies(const CensusGrid& grid)
      : time{"time", "time", "Time from the start", grid.times},
        p{"p", "momentum", "Middle of the bin", grid.bins.middles()},
        speed{"speed", "momentum", "|p|, geometric middle of the bin", grid.speeds.middles()},
        number_time{"time", "time", "Time from the start", grid.number_times} {}
};

/// Observer that fills CensusTallies.
class Census {
 public:
  explicit Census(const CensusGrid& grid)
      : at_times_(grid.times),
        at_number_times_(grid.number_times),
        speeds_(grid.speeds),
        lowest_(grid.speeds.points().front()),
        highest_(grid.speeds.points().back()),
        linear_(grid.times.size(), Histogram(grid.bins)),
        logarithmic_(grid.times.size(), std::vector<double>(grid.speeds.intervals(), 0)),
        slower_(grid.times.size(), 0),
        number_(grid.number_times.size(), 0) {}

  void on_flight(const Path& path) {
    at_times_.show(path, [&](std::size_t k) {
      const double p = std::abs(path.velocity);
      linear_[k].add(path.velocity, p);
      if (p < lowest_)
        slower_[k] += 1;
      else if (p < highest_)
        logarithmic_[k][speeds_.interval(p)] += 1;
    });
    at_number_times_.show(path, [&](std::size_t k) { number_[k] += 1; });
  }

  void record(const CensusTallies& tallies, TallySums& sums) const {
    for (std::size_t k = 0; k < linear_.size(); ++k) {
      const std::vector<double>& weights = linear_[k].weights();
      sums.set(tallies.momentum.row(k), weights);
      sums.set(tallies.by_speed.row(k), logarithmic_[k]);
    }
    sums.set(tallies.slower, slower_);
    sums.set(tallies.number, number_);
  }

 private:
  /// Finds which of the given times lie in a flight.
  class Snapshots {
   public:
    explicit Snapshots(const std::vector<double>& times) : times_(times), next_time_(times.front()) {}

    /// Calls see(k) for every time k in [departure, arrival). Paths must be in ascending order of departure.
    /// Most flights contain no time and end at the first test.
    template <class See>
    void show(const Path& path, See&& see) {
      if (!(next_time_ < path.arrival)) [[likely]]
        return;
      while (next_ < times_.size() && times_[next_] < path.departure) ++next_;
      for (std::size_t k = next_; k < times_.size() && times_[k] < path.arrival; ++k) see(k);
      next_time_ = next_ < times_.size() ? times_[next_] : std::numeric_limits<double>::infinity();
    }

   private:
    std::vector<double> times_;
    std::size_t next_ = 0;
    double next_time_;  // times_[next_], or infinity after the last time
  };

  Snapshots at_times_, at_number_times_;
  LogGrid speeds_;
  double lowest_, highest_;
  std::vector<Histogram> linear_;
  std::vector<std::vector<double>> logarithmic_;
  std::vector<double> slower_, number_;
};

}  // namespace lorentz
