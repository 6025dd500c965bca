/// Waiting times: the density Psi(tau) of the time between two successive scatterings of a particle.
///
/// tau = (cells flown) lambda/|u| is known when the flight begins and is recorded then, so nothing is
/// censored by the end of the run. Momenta after a scattering have a density that is smooth at u = 0, so
/// Psi ~ tau^-2; only at sigma = 0, where momenta are merely exchanged, does the flux weight |u| of the
/// initial Gaussian stay, and Psi ~ tau^-3.
///
/// The exponent is the maximum-likelihood one of the tail above a cut, -(1 + n / sum ln(tau/cut)) (Hill
/// 1975). Corrections to the power law are of relative size (lambda/tau)^2/T, so the cut stands at twenty
/// thermal flights, and the exponents at cuts from a third to three times that give the systematic spread.
#include <algorithm>
#include <cmath>

#include "model/portable.hpp"
#include "observables/closed_chain_options.hpp"
#include "program/replica_study.hpp"
#include "statistics/log_grid.hpp"
#include "statistics/log_sum.hpp"

namespace {

using namespace lorentz;

constexpr double decades = 12;
constexpr std::size_t bins_per_decade = 10;

class WaitingTimes {
 public:
  explicit WaitingTimes(const LogGrid& grid) : grid_(grid), bins_(grid.intervals()) {}

  void on_flight(const Departure& departure) {
    if (!std::isfinite(departure.duration)) return;  // frozen
    Bin& bin = bins_[grid_.interval(departure.duration)];
    ++bin.count;
    bin.logarithms.add(departure.duration);
  }

  /// Counts per bin, then sums of ln tau per bin.
  std::vector<double> sums() const {
    std::vector<double> result;
    for (const Bin& bin : bins_) result.push_back(static_cast<double>(bin.count));
    for (const Bin& bin : bins_) result.push_back(bin.logarithms.sum());
    return result;
  }

 private:
  struct Bin {
    std::uint64_t count = 0;
    LogSum logarithms;
  };

  const LogGrid& grid_;
  std::vector<Bin> bins_;
};

/// Probability per unit time in every bin.
std::vector<double> density(std::span<const double> sums, const LogGrid& bins) {
  const std::vector<double> edges = bins.points();
  double total = 0;
  for (const double count : sums.first(bins.intervals())) total += count;
  std::vector<double> result;
  for (std::size_t bin = 0; bin < bins.intervals(); ++bin)
    result.push_back(sums[bin] / total / (edges[bin + 1] - edges[bin]));
  return result;
}

/// Exponents of the tails above the lower edge of every bin; NaN above all counts.
std::vector<double> exponents(std::span<const double> sums, const LogGrid& bins) {
  const std::vector<double> edges = bins.points();
  std::vector<double> result(bins.intervals());
  double count = 0, log_sum = 0;
  for (std::size_t bin = bins.intervals(); bin-- > 0;) {
    count += sums[bin];
    log_sum += sums[bins.intervals() + bin];
    result[bin] = -(1 + count / (log_sum - count * portable::log(edges[bin])));
  }
  return result;
}

struct Tail {
  std::size_t lowest, chosen, highest;  // bins whose lower edges are the cuts
};

Results summarise(const Records& records, const LogGrid& bins, const Tail& tail) {
  std::vector<double> cuts = bins.points();
  cuts.pop_back();
  const Axis tau{"tau", "time", "Geometric middle of the bin", bins.middles()};
  const Axis cut{"cut", "time", "Shortest waiting time of the tail", cuts};
  return estimate(
      records,
      {{"density", "1/time", "Probability density of the time between two scatterings of a particle", {tau}},
       {"exponent_by_cut", "1", "Maximum-likelihood exponent of the tail above the cut", {cut}},
       {"exponent", "1", "Exponent of the tail above --tail-from thermal flights"},
       {"exponent_spread", "1", "Largest difference of exponents for cuts within a factor of three"}},
      [&](std::span<const double> sums) {
        std::vector<double> values = density(sums, bins);
        const std::vector<double> by_cut = exponents(sums, bins);
        const auto at = [&](std::size_t bin) { return by_cut.begin() + static_cast<std::ptrdiff_t>(bin); };
        const auto [low, high] = std::minmax_element(at(tail.lowest), at(tail.highest + 1));
        values.insert(values.end(), by_cut.begin(), by_cut.end());
        values.push_back(by_cut[tail.chosen]);
        values.push_back(*high - *low);
        return values;
      });
}

}  // namespace

int main(int argc, char** argv) {
  Program program("waiting_time",
                  "Distribution of the time between two scatterings of a particle, in a closed chain");
  ClosedChainOptions chain(/*relaxation_time=*/100, /*observation_time=*/200);
  chain.declare(program.options());
  double tail_from = 20;
  program.options().real("--tail-from", tail_from, {1, 1e6},
                         "Lower cut of the tail, in flights of one cell at thermal speed");
  ReplicaOptions replicas(program);
  replicas.declare(program.options());
  return program.run(argc, argv, [&](Progress& progress) {
    chain.validate();
    const double thermal_flight = chain.chain().cell_length / std::sqrt(chain.temperature());
    const LogGrid bins(1e-3 * thermal_flight, decades, bins_per_decade);
    const auto bin_of_cut = [&](double factor) {  // a cut that lies on an edge begins there
      return bins.interval(factor * tail_from * thermal_flight * (1 + 1e-9));
    };
    const Tail tail{bin_of_cut(1.0 / 3), bin_of_cut(1), bin_of_cut(3)};
    const auto measure = [&](const Replica& replica) {
      WaitingTimes waits(bins);
      ClosedReplica run(chain, replica);
      run.relax();
      run.observe_until(chain.end_time(), waits);
      return run.record(waits.sums());
    };
    const auto results = [&](const Records& records) { return summarise(records, bins, tail); };
    return replicas.run({measure, with_drift(results), "exponent", RandomStream::description}, progress);
  });
}
