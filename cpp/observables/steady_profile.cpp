/// Profiles of an open chain in its stationary state, averaged over a window of time: temperatures of
/// scatterers and particles, density, rates of arrivals, currents, and the momentum distribution of the end
/// scatterers.
///
/// The particles' temperature is <p^2>/m over the arrivals at a scatterer, so that of the flux, not of the
/// density: the density holds slow particles, whose number grows with the logarithm of time, so it goes with
/// its window. All means are corrected by what the reservoirs happened to inject
/// (statistics/control_variates.hpp). Differences, deviations and slopes are quantities of their own, because
/// neighbouring cells and bonds share their noise. The bulk of the density is a line through the middle half
/// of the chain.
#include <cmath>
#include <limits>
#include <numeric>

#include "observables/momentum_bins_options.hpp"
#include "observables/open_chain_options.hpp"
#include "program/replica_study.hpp"
#include "statistics/control_variates.hpp"
#include "statistics/fit.hpp"
#include "statistics/histogram.hpp"
#include "statistics/range_tally.hpp"
#include "statistics/time_integral.hpp"

namespace {

using namespace lorentz;

/// What passes the marks of a chain in one direction in a window, and how long particles stay in the cells.
///
/// A flight from a scatterer or an opening to another, all of it in the window, is entered by its bonds: with
/// each it reaches the scatterer behind, if there is one, and it stays one time_per_place in each of the two
/// half cells at the bond. The others, those at the ends of the window, are entered mark by mark.
class Stream {
 public:
  Stream(const OpenChain& chain, const Window& window)
      : window_(window),
        cells_(chain.cells),
        bonds_(cells_ + 1),
        marks_(2 * cells_ + 1),
        residence_(cells_) {}

  void add(const Path& path) {
    // One that departs at the beginning may come from anywhere.
    if (!(path.departure > window_.begin && path.arrival < window_.end)) return add_clipped(path);
    const Marks marks = marks_in(path, window_);
    bonds_.add((marks.low + 1) / 2, marks.high / 2, {1, path.velocity * path.velocity, path.time_per_place});
  }

  [[gnu::cold]] void add_clipped(const Path& path) {
    const Marks marks = marks_in(path, window_);
    marks_.add(marks.low, marks.high, {1, path.velocity * path.velocity});
    const Stretch stretch = stretch_in(path, window_);
    if (stretch.duration > 0) residence_.spread(0.5 * stretch.low, 0.5 * stretch.high, {stretch.duration});
  }

  /// Arrivals (kind 0) or the sums of their u^2 (kind 1) at every mark; behind: the scatterer behind a bond,
  /// as seen from the bond.
  std::vector<double> at_marks(std::size_t kind, std::ptrdiff_t behind) const {
    std::vector<double> sums = marks_.sums(kind);
    const std::vector<double> bonds = bonds_.sums(kind);
    for (std::size_t bond = 0; bond <= cells_; ++bond) {
      sums[2 * bond] += bonds[bond];
      const std::size_t scatterer = 2 * bond + static_cast<std::size_t>(behind);
      if (scatterer < sums.size()) sums[scatterer] += bonds[bond];
    }
    return sums;
  }

  /// Time that particles spend in every cell.
  std::vector<double> residence() const {
    std::vector<double> times = residence_.sums();
    const std::vector<double> halves = bonds_.sums(2);
    for (std::size_t cell = 0; cell < cells_; ++cell) times[cell] += halves[cell] + halves[cell + 1];
    return times;
  }

 private:
  Window window_;
  std::size_t cells_;
  RangeTally<3> bonds_;
  RangeTally<2> marks_;
  RangeTally<> residence_;
};

class Profile {
 public:
  Profile(const OpenChain& chain, const Window& window, const Bins& bins)
      : chain_(chain),
        window_(window),
        streams_(2, Stream(chain, window)),
        scatterers_(chain.cells, TimeIntegral(Blocks(window.begin, window.end, 1))),
        last_collision_(2, window.begin),
        momenta_(2, Histogram(bins)) {}

  void on_flight(const Path& path) { streams_[path.rightwards() ? 0 : 1].add(path); }

  void on_collision(const Collision& collision) {
    hold(collision.scatterer, collision.scatterer_before, collision.time);
  }

  void on_injection(End end, double, double u) { controls_.add(end, u); }

  void finish(const std::vector<double>& scatterers, double end_time) {
    for (std::uint32_t cell = 0; cell < chain_.cells; ++cell) hold(cell, scatterers[cell], end_time);
  }

  /// Per unit time, cell after cell: temperature of the scatterer, residence of particles; arrivals to the
  /// right and to the left at every mark, then the sums of their u^2; momenta of both end scatterers, bin
  /// after bin; the controls.
  std::vector<double> record() const {
    std::vector<double> values;
    const double duration = window_.end - window_.begin;
    const auto append = [&](const std::vector<double>& sums) {
      for (const double sum : sums) values.push_back(sum / duration);
    };
    for (const TimeIntegral& scatterer : scatterers_) append(scatterer.sums());
    const std::vector<double> rightwards = streams_[0].residence(), leftwards = streams_[1].residence();
    for (std::size_t cell = 0; cell < chain_.cells; ++cell) append({rightwards[cell] + leftwards[cell]});
    for (const std::size_t kind : {0, 1}) {
      append(streams_[0].at_marks(kind, 1));
      append(streams_[1].at_marks(kind, -1));
    }
    for (const Histogram& histogram : momenta_) append(histogram.weights());
    controls_.append_to(values, chain_, duration);
    return values;
  }

 private:
  void hold(std::uint32_t cell, double U, double until) {
    scatterers_[cell].hold(U * U, until);
    if (cell == 0) hold_end(0, U, until);
    if (cell + 1 == chain_.cells) hold_end(1, U, until);
  }

  void hold_end(std::size_t end, double U, double until) {
    momenta_[end].add(U, until - last_collision_[end]);
    last_collision_[end] = until;
  }

  OpenChain chain_;
  Window window_;
  std::vector<Stream> streams_;  // to the right, to the left
  std::vector<TimeIntegral> scatterers_;
  std::vector<double> last_collision_;  // of the end scatterers, in the window
  std::vector<Histogram> momenta_;
  InjectionControls controls_;
};

std::vector<double> numbers(std::size_t size) {
  std::vector<double> values(size);
  std::iota(values.begin(), values.end(), 0.0);
  return values;
}

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Straight line through the values of a range of cells; NaN with fewer than two.
Line line_through(std::span<const double> values, std::size_t first, std::size_t count) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (count < 2) return {none, none};
  const std::vector<double> x = numbers(values.size());
  return fit_line(std::span(x).subspan(first, count), values.subspan(first, count));
}

/// A mean record, read cell by cell or bond by bond.
class Reading {
 public:
  Reading(std::span<const double> row, std::size_t cells) : row_(row), cells_(cells), marks_(2 * cells + 1) {}

  std::vector<double> scatterer() const { return part(0); }
  std::vector<double> density() const { return part(1); }
  std::vector<double> particle() const {
    return at(1, [&](std::size_t i) {
      return (squares(0, i) + squares(1, i)) / (arrivals(0, i) + arrivals(1, i));
    });
  }
  std::vector<double> difference() const {
    std::vector<double> values = scatterer();
    const std::vector<double> others = particle();
    for (std::size_t cell = 0; cell < cells_; ++cell) values[cell] -= others[cell];
    return values;
  }

  /// At the scatterers, to the right (0) or to the left (1).
  std::vector<double> rate(std::size_t side) const {
    return at(1, [&](std::size_t i) { return arrivals(side, i); });
  }
  std::vector<double> rate_deviation(std::size_t side) const {
    std::vector<double> values = rate(side);
    const Line line = line_through(values, 0, cells_);
    for (std::size_t cell = 0; cell < cells_; ++cell)
      values[cell] -= line.intercept + line.slope * static_cast<double>(cell);
    return values;
  }

  /// At the bonds.
  std::vector<double> particle_current() const {
    return at(0, [&](std::size_t i) { return arrivals(0, i) - arrivals(1, i); });
  }
  std::vector<double> energy_current() const {
    return at(0, [&](std::size_t i) { return 0.5 * (squares(0, i) - squares(1, i)); });
  }

  /// Over the length of the chain, relative to the mean of the middle half.
  double density_slope() const {
    const std::vector<double> values = density();
    const Line line = bulk(values);
    return line.slope * static_cast<double>(cells_) / (line.intercept + line.slope * middle());
  }
  std::vector<double> density_excess() const {
    const std::vector<double> values = density();
    const Line line = bulk(values);
    return {values.front() / line.intercept - 1,
            values.back() / (line.intercept + line.slope * 2 * middle()) - 1};
  }

  std::span<const double> momenta() const { return row_.subspan(2 * cells_ + 4 * marks_); }

 private:
  std::vector<double> part(std::size_t k) const {
    const auto values = row_.subspan(k * cells_, cells_);
    return {values.begin(), values.end()};
  }
  double arrivals(std::size_t side, std::size_t mark) const {
    return row_[2 * cells_ + side * marks_ + mark];
  }
  double squares(std::size_t side, std::size_t mark) const {
    return row_[2 * cells_ + (2 + side) * marks_ + mark];
  }
  double middle() const { return 0.5 * static_cast<double>(cells_ - 1); }
  Line bulk(const std::vector<double>& values) const {
    return line_through(values, cells_ / 4, cells_ - 2 * (cells_ / 4));
  }

  /// first: 0 for bonds, 1 for scatterers.
  template <class Value>
  std::vector<double> at(std::size_t first, const Value& value) const {
    std::vector<double> values;
    for (std::size_t i = first; i < marks_; i += 2) values.push_back(value(i));
    return values;
  }

  std::span<const double> row_;
  std::size_t cells_, marks_;
};

std::vector<double> minus(std::vector<double> values, double subtrahend) {
  for (double& value : values) value -= subtrahend;
  return values;
}

Results summarise(const Records& records, std::size_t cells, const Bins& bins) {
  const Axis cell{"cell", "1", "Cell number, from 0", numbers(cells)};
  const Axis bond{"bond", "1", "Bond number; 0 and N are the openings", numbers(cells + 1)};
  const Axis end{"end", "1", "0: first cell, 1: last", {0, 1}};
  const Axis momentum{"momentum", "momentum", "P/sqrt(M), middle of the bin", bins.middles()};
  return estimate(
      reduce_variance(records, InjectionControls::count),
      {{"temperature_scatterer", "temperature", "Time average of P^2/M", {cell}},
       {"temperature_particle", "temperature", "<p^2>/m over the arrivals at the scatterer", {cell}},
       {"temperature_difference", "temperature", "That of the scatterer minus that of the particles", {cell}},
       {"density", "1", "Mean number of particles in the cell, frozen ones included", {cell}},
       {"density_slope", "1", "Of the line through the middle half, over the chain and relative to its mean"},
       {"density_excess", "1", "Density of an end cell over that line, minus 1", {end}},
       {"rate_right", "1/time", "Arrivals at the scatterer to the right", {cell}},
       {"rate_left", "1/time", "Arrivals at the scatterer to the left", {cell}},
       {"rate_right_deviation", "1/time", "rate_right minus a straight line through it", {cell}},
       {"rate_left_deviation", "1/time", "rate_left minus a straight line through it", {cell}},
       {"particle_current", "1/time", "J_n, positive to the right", {bond}},
       {"energy_current", "energy/time", "J_U, positive to the right", {bond}},
       {"particle_current_mean", "1/time", "Mean of J_n over the bonds"},
       {"energy_current_mean", "energy/time", "Mean of J_U over the bonds"},
       {"particle_current_deviation", "1/time", "J_n minus its mean over the bonds", {bond}},
       {"energy_current_deviation", "energy/time", "J_U minus its mean over the bonds", {bond}},
       {"scatterer_density", "1/momentum", "Probability density of P/sqrt(M)", {end, momentum}}},
      [&](std::span<const double> row) {
        const Reading reading(row, cells);
        const std::vector<double> particles = reading.particle_current(), energy = reading.energy_current();
        std::vector<double> values;
        const auto append = [&](std::span<const double> more) {
          values.insert(values.end(), more.begin(), more.end());
        };
        append(reading.scatterer());
        append(reading.particle());
        append(reading.difference());
        append(reading.density());
        values.push_back(reading.density_slope());
        append(reading.density_excess());
        append(reading.rate(0));
        append(reading.rate(1));
        append(reading.rate_deviation(0));
        append(reading.rate_deviation(1));
        append(particles);
        append(energy);
        values.insert(values.end(), {mean(particles), mean(energy)});
        append(minus(particles, mean(particles)));
        append(minus(energy, mean(energy)));
        for (const double weight : reading.momenta().first(2 * bins.count()))
          values.push_back(weight / bins.width());
        return values;
      });
}

}  // namespace

int main(int argc, char** argv) {
  Program program("steady_profile", "Profiles of an open chain in its stationary state");
  OpenChainOptions options({.cell_length = 0}, "warm", {{{100}, {1000}}});
  options.declare(program.options());
  MomentumBinsOptions bins(100, 60);
  bins.declare(program.options());
  ReplicaOptions replicas(program);
  replicas.declare(program.options());
  return program.run(argc, argv, [&](Progress& progress) {
    options.validate();
    bins.validate();
    const OpenChain chain = options.chain();
    const Window window = options.window();
    const auto measure = [&](const Replica& replica) {
      return options.measure(replica, window, Profile(chain, window, bins.bins()));
    };
    const auto results = [&](const Records& records) { return summarise(records, chain.cells, bins.bins()); };
    return replicas.run({measure, results, "energy_current_mean", RandomStream::description}, progress);
  });
}
