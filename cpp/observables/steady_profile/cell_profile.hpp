#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/observation.hpp"
#include "engine/open_dynamics.hpp"
#include "engine/path.hpp"
#include "sampling/momentum_bins.hpp"
#include "sampling/stationarity.hpp"
#include "statistics/histogram.hpp"
#include "statistics/range_tally.hpp"
#include "statistics/tally.hpp"
#include "statistics/time_integral.hpp"

namespace lorentz {

/// Tallies of the cells and bonds of an open chain, per unit time.
struct CellTallies : StationaryTallies {
  Axis cell, bond, momentum;
  Axis end{"end", "1", "0: first cell, 1: last", {0, 1}};
  Axis direction{"direction", "1", "-1: to the left, 1: to the right", {-1, 1}};
  Tally temperature = tally("temperature_scatterer", {cell}, "temperature", "Time average of P^2/M");
  Tally density = tally("density", {cell}, "1", "Mean number of particles in the cell, frozen ones included");
  Tally arrivals = tally("arrivals", {direction, cell}, "1/time", "Arrivals at the scatterer");
  Tally arriving_squares =
      tally("arriving_squares", {direction, cell}, "momentum^2/time", "Sum of u^2 over arrivals");
  // Net currents, not crossings by direction: the injection controls determine those that enter at an
  // opening.
  Tally particle_current = tally("particle_current", {bond}, "1/time", "J_n, positive to the right");
  Tally energy_current = tally("energy_current", {bond}, "energy/time", "J_U, positive to the right");
  Tally end_momentum = tally("end_momentum", {end, momentum}, "1",
                             "Part of the time that an end scatterer spends in a bin of U");

  CellTallies(std::size_t cells, const Bins& bins)
      : cell(numbered_axis("cell", "Cell number, from 0", cells)),
        bond(numbered_axis("bond", "Bond number; 0 and N are the openings", cells + 1)),
        momentum{"scaled_momentum", "momentum", "P/sqrt(M), middle of the bin", bins.middles()} {}
};

/// Passages of the marks of a chain in one direction during a window, and the times that particles spend in
/// the cells [eq. 34].
///
/// A flight that lies in the window is added to its range of bonds only: each bond implies one arrival at the
/// scatterer behind it, if there is one, and a stay of time_per_half_cell in each of its two half cells.
/// Flights that overlap an end of the window are added mark by mark.
class CellStream {
 public:
  /// Sums over passages: their number, u^2, and the time of a half cell.
  enum Kind : std::size_t { passages, squares, half_cell_times };

  CellStream(const OpenChain& chain, const Window& window)
      : window_(window),
        cells_(chain.cells),
        bonds_(cells_ + 1),
        marks_(2 * cells_ + 1),
        residence_(cells_) {}

  // Inlined with its callers, without which GCC executes 11 % more instructions.
  [[gnu::always_inline]] void add(const Path& path) {
    // A path that departs exactly at the beginning of the window may start anywhere in a cell.
    if (!(path.departure > window_.begin && path.arrival < window_.end)) return add_clipped(path);
    const Marks marks = marks_in(path, window_);
    bonds_.add((marks.low + 1) / 2, marks.high / 2,
               {1, path.velocity * path.velocity, path.time_per_half_cell});
  }

  /// Sums of one kind over the passages of every mark; `behind` is the offset from a bond to the scatterer
  /// behind it.
  std::vector<double> at_marks(Kind kind, std::ptrdiff_t behind) const {
    std::vector<double> sums = marks_.sums(kind);
    const std::vector<double> bonds = bonds_.sums(kind);
    for (std::size_t bond = 0; bond <= cells_; ++bond) {
      sums[2 * bond] += bonds[bond];
      const std::size_t scatterer = 2 * bond + static_cast<std::size_t>(behind);
      if (scatterer < sums.size()) sums[scatterer] += bonds[bond];
    }
    return sums;
  }

  /// Time that particles spend in every cell, summed over particles.
  std::vector<double> residence() const {
    std::vector<double> times = residence_.sums();
    const std::vector<double> halves = bonds_.sums(half_cell_times);
    for (std::size_t cell = 0; cell < cells_; ++cell) times[cell] += halves[cell] + halves[cell + 1];
    return times;
  }

 private:
  [[gnu::cold]] void add_clipped(const Path& path) {
    const Marks marks = marks_in(path, window_);
    marks_.add(marks.low, marks.high, {1, path.velocity * path.velocity});
    const Stretch stretch = stretch_in(path, window_);
    if (stretch.duration > 0) residence_.spread(0.5 * stretch.low, 0.5 * stretch.high, {stretch.duration});
  }

  Window window_;
  std::size_t cells_;
  RangeTally<3> bonds_;
  RangeTally<2> marks_;
  RangeTally<> residence_;
};

/// Observer that fills CellTallies [eq. 25, eq. 26].
class CellProfile {
 public:
  CellProfile(const OpenChain& chain, const Window& window, const Bins& bins)
      : chain_(chain),
        window_(window),
        streams_(2, CellStream(chain, window)),
        scatterers_(chain.cells, TimeIntegral(Blocks(window.begin, window.end, 1))),
        last_collision_(2, window.begin),
        momenta_(2, Histogram(bins)) {}

  [[gnu::always_inline]] void on_flight(const Path& path) { streams_[path.direction()].add(path); }

  void on_scatterer(std::uint32_t cell, double before, double time) { advance(cell, before, time); }

  void finish(const std::vector<double>& scatterers, double end_time) {
    for (std::uint32_t cell = 0; cell < chain_.cells; ++cell) advance(cell, scatterers[cell], end_time);
  }

  void record(const CellTallies& tallies, TallySums& sums) const {
    const double duration = window_.end - window_.begin;
    const std::size_t cells = chain_.cells;
    const std::vector<double> to_right = streams_[rightwards].residence();
    const std::vector<double> to_left = streams_[leftwards].residence();
    for (std::size_t cell = 0; cell < cells; ++cell) {
      sums[tallies.temperature][cell] = scatterers_[cell].sums().front() / duration;
      sums[tallies.density][cell] = (to_right[cell] + to_left[cell]) / duration;
    }
    for (const Direction side : {leftwards, rightwards}) {
      const int sign = side == rightwards ? 1 : -1;
      const std::vector<double> numbers = streams_[side].at_marks(CellStream::passages, sign);
      const std::vector<double> squares = streams_[side].at_marks(CellStream::squares, sign);
      for (std::size_t cell = 0; cell < cells; ++cell) {
        sums[tallies.arrivals.row(side)][cell] = numbers[2 * cell + 1] / duration;
        sums[tallies.arriving_squares.row(side)][cell] = squares[2 * cell + 1] / duration;
      }
      for (std::size_t bond = 0; bond <= cells; ++bond) {
        sums[tallies.particle_current][bond] += sign * numbers[2 * bond] / duration;
        sums[tallies.energy_current][bond] += sign * 0.5 * squares[2 * bond] / duration;
      }
    }
    for (const std::size_t end : {0U, 1U})
      std::ranges::transform(momenta_[end].weights(), sums[tallies.end_momentum.row(end)].begin(),
                             [duration](double time) { return time / duration; });
  }

 private:
  /// Adds the time since the last call up to `until`, during which the scatterer had this U.
  [[gnu::always_inline]] void advance(std::uint32_t cell, double U, double until) {
    scatterers_[cell].advance(U * U, until);
    if (cell == 0) advance_end(0, U, until);
    if (cell + 1 == chain_.cells) advance_end(1, U, until);
  }

  void advance_end(std::size_t end, double U, double until) {
    momenta_[end].add(U, until - last_collision_[end]);
    last_collision_[end] = until;
  }

  OpenChain chain_;
  Window window_;
  std::vector<CellStream> streams_;  // by Direction
  std::vector<TimeIntegral> scatterers_;
  std::vector<double> last_collision_;  // of either end scatterer, or the beginning of the window
  std::vector<Histogram> momenta_;
};

}  // namespace lorentz
