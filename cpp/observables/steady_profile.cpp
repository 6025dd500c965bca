/// Profiles of an open chain in its stationary state, averaged over a window of time: temperatures of
/// scatterers and particles, density, rates of arrivals, currents, and the momentum distribution of the end
/// scatterers.
///
/// The particles' temperature is <p^2>/m over the arrivals at a scatterer, so that of the flux, not of the
/// density: the density holds slow particles, whose number grows with the logarithm of time, so it goes with
/// its window. All means are corrected by what the reservoirs happened to inject
/// (statistics/control_variates.hpp).
#include <cmath>
#include <numeric>

#include "observables/momentum_bins_options.hpp"
#include "observables/open_chain_options.hpp"
#include "program/replica_study.hpp"
#include "statistics/control_variates.hpp"
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

Results summarise(const Records& records, std::size_t cells, const Bins& bins) {
  const auto numbers = [](std::size_t size) {
    std::vector<double> values(size);
    std::iota(values.begin(), values.end(), 0.0);
    return values;
  };
  const Axis cell{"cell", "1", "Cell number, from 0", numbers(cells)};
  const Axis bond{"bond", "1", "Bond number; 0 and N are the openings", numbers(cells + 1)};
  const Axis end{"end", "1", "0: first scatterer, 1: last", {0, 1}};
  const Axis momentum{"momentum", "momentum", "P/sqrt(M), middle of the bin", bins.middles()};
  const std::size_t marks = 2 * cells + 1;
  return estimate(
      reduce_variance(records, InjectionControls::count),
      {{"temperature_scatterer", "k_B T", "Time average of P^2/M", {cell}},
       {"density", "1", "Mean number of particles in the cell, frozen ones included", {cell}},
       {"temperature_particle", "k_B T", "<p^2>/m over the arrivals at the scatterer", {cell}},
       {"rate_right", "1/time", "Arrivals at the scatterer to the right", {cell}},
       {"rate_left", "1/time", "Arrivals at the scatterer to the left", {cell}},
       {"particle_current", "1/time", "J_n, positive to the right", {bond}},
       {"energy_current", "energy/time", "J_U, positive to the right", {bond}},
       {"particle_current_mean", "1/time", "Mean of J_n over the bonds"},
       {"energy_current_mean", "energy/time", "Mean of J_U over the bonds"},
       {"scatterer_density", "1/momentum", "Probability density of P/sqrt(M)", {end, momentum}}},
      [&](std::span<const double> row) {
        const std::span<const double> right = row.subspan(2 * cells, marks),
                                      left = row.subspan(2 * cells + marks, marks),
                                      right_squares = row.subspan(2 * cells + 2 * marks, marks),
                                      left_squares = row.subspan(2 * cells + 3 * marks, marks);
        std::vector<double> values(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(2 * cells));
        const auto at_scatterers = [&](auto&& value) {
          for (std::size_t i = 1; i < marks; i += 2) values.push_back(value(i));
        };
        at_scatterers(
            [&](std::size_t i) { return (right_squares[i] + left_squares[i]) / (right[i] + left[i]); });
        at_scatterers([&](std::size_t i) { return right[i]; });
        at_scatterers([&](std::size_t i) { return left[i]; });
        std::vector<double> particles, energy;
        for (std::size_t i = 0; i < marks; i += 2) {
          particles.push_back(right[i] - left[i]);
          energy.push_back(0.5 * (right_squares[i] - left_squares[i]));
        }
        for (const auto* current : {&particles, &energy})
          values.insert(values.end(), current->begin(), current->end());
        for (const auto* current : {&particles, &energy})
          values.push_back(std::accumulate(current->begin(), current->end(), 0.0) /
                           static_cast<double>(cells + 1));
        for (const double weight : row.subspan(2 * cells + 4 * marks, 2 * bins.count()))
          values.push_back(weight / bins.width());
        return values;
      });
}

}  // namespace

int main(int argc, char** argv) {
  Program program("steady_profile", "Profiles of an open chain in its stationary state");
  const OpenChainOptions options(program.options(), {.cell_length = 0}, "warm", {{100}, {1000}});
  const MomentumBinsOptions bins(program.options(), 100, 60);
  const ReplicaOptions replicas(program);
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
