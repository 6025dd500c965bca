/// Waiting times: probability density Psi(tau) of the time between two successive scatterings of a particle.
///
/// tau = (cells flown) lambda/|u| is known when a flight begins and is recorded then, so that the end of the
/// run censors no waiting time. The density of the momenta after a scattering is smooth at u = 0, so Psi ~
/// tau^-2 [eq. 15]. Only at sigma = 0, where collisions exchange momenta, the flux weight |u| of the initial
/// Gaussian is conserved, and Psi ~ tau^-3 [eq. 16].
///
/// The exponent is the maximum-likelihood estimate (Hill 1975) for the tail above a cut [eq. 17]. Corrections
/// to the power law are of relative size (lambda/tau)^2/T. The cut is twenty thermal flights, and the
/// exponents for cuts between a third and three times that give the systematic error.
#include <algorithm>
#include <cmath>

#include "sampling/closed_run.hpp"
#include "statistics/log_grid.hpp"

namespace {

using namespace lorentz;

constexpr double decades = 12;
constexpr std::size_t bins_per_decade = 10;

struct Parameters : ClosedParameters {
  double tail_from = 20;

  Parameters() { observation_time = 200; }
  /// Time of a flight over one cell at the thermal speed.
  double thermal_flight() const { return ring.cell_length / std::sqrt(temperature); }
  /// From a time on that no particle is fast enough for: 1e-3 flights at the higher one of both temperatures.
  /// The last bin, which is not shown, has all times beyond the others.
  LogGrid bins() const {
    return {1e-3 * ring.cell_length / std::sqrt(hottest()), decades + 1. / bins_per_decade, bins_per_decade};
  }
};

struct Tallies : ClosedTallies {
  Axis tau, bin;
  Tally count = tally("count", {bin}, "1", "Waiting times in a bin");
  Tally log_sum = tally("log_sum", {bin}, "1", "Sum of ln tau in a bin");

  explicit Tallies(const LogGrid& bins)
      : tau{"tau", "time", "Geometric middle of the bin", bins.middles()},
        bin(numbered_axis("bin", "Bins of tau, and that of times beyond them", bins.intervals())) {
    tau.values.pop_back();
  }
};

/// Sum of the logarithms of positive numbers, computed from products, so that few logarithms are evaluated.
class LogSum {
 public:
  void add(double number) {
    const double product = product_ * number;
    if (product > 0x1p-1000 && product < 0x1p1000) [[likely]] {
      product_ = product;
    } else {
      sum_ += std::log(product_) + std::log(number);
      product_ = 1;
    }
  }

  double sum() const { return sum_ + std::log(product_); }

 private:
  double product_ = 1;
  double sum_ = 0;  // of the numbers that are not in the product
};

class WaitingTimes {
 public:
  explicit WaitingTimes(const LogGrid& grid) : grid_(grid), bins_(grid.intervals()) {}

  void on_flight(const Departure& departure) {
    if (!std::isfinite(departure.duration)) return;  // a particle at rest does not arrive
    Bin& bin = bins_[grid_.interval(departure.duration)];
    ++bin.count;
    bin.logarithms.add(departure.duration);
  }

  void record(const Tallies& tallies, TallySums& sums) const {
    for (std::size_t bin = 0; bin < bins_.size(); ++bin) {
      sums[tallies.count][bin] = static_cast<double>(bins_[bin].count);
      sums[tallies.log_sum][bin] = bins_[bin].logarithms.sum();
    }
  }

 private:
  struct Bin {
    std::uint64_t count = 0;
    LogSum logarithms;
  };

  const LogGrid& grid_;
  std::vector<Bin> bins_;
};

/// Probability density in every bin but the last, which counts in the total.
std::vector<double> density(std::span<const double> counts, const std::vector<double>& edges) {
  double total = 0;
  for (const double count : counts) total += count;
  std::vector<double> result;
  for (std::size_t bin = 0; bin + 1 < counts.size(); ++bin)
    result.push_back(counts[bin] / total / (edges[bin + 1] - edges[bin]));
  return result;
}

/// Maximum-likelihood exponents of the tails above the lower edge of every bin [eq. 17]; NaN above all
/// counts.
std::vector<double> exponents(std::span<const double> counts, std::span<const double> log_sums,
                              const std::vector<double>& edges) {
  std::vector<double> result(counts.size());
  double count = 0, log_sum = 0;
  for (std::size_t bin = counts.size(); bin-- > 0;) {
    count += counts[bin];
    log_sum += log_sums[bin];
    result[bin] = -(1 + count / (log_sum - count * std::log(edges[bin])));
  }
  return result;
}

Group waiting_times(const Parameters& parameters, const Tallies& tallies) {
  const LogGrid bins = parameters.bins();
  const std::vector<double> edges = bins.points();
  const auto bin_of_cut = [&](double factor) {  // rounding does not move a cut on an edge to the bin below
    return bins.interval(factor * parameters.tail_from * parameters.thermal_flight() * (1 + 1e-9));
  };
  const std::size_t lowest = bin_of_cut(1.0 / 3), chosen = bin_of_cut(1), highest = bin_of_cut(3);
  const auto by_cut = [=](TallyMeans mean) {
    return exponents(mean[tallies.count], mean[tallies.log_sum], edges);
  };

  Group group;
  group.quantity("density", {tallies.tau}, "1/time",
                 "Probability density of the time between two scatterings of a particle",
                 [=](TallyMeans mean) { return density(mean[tallies.count], edges); });
  group.quantity("exponent", "1", "Exponent of the tail above --tail-from thermal flights",
                 [=](TallyMeans mean) { return by_cut(mean)[chosen]; });
  group.quantity("exponent_spread", "1", "Largest difference of exponents for cuts within a factor of three",
                 [=](TallyMeans mean) {
                   const std::vector<double> all = by_cut(mean);
                   const auto [low, high] =
                       std::ranges::minmax(std::span(all).subspan(lowest, highest + 1 - lowest));
                   return high - low;
                 });
  return group;
}

Study waiting_time(const Parameters& parameters) {
  validate(parameters);
  const LogGrid bins = parameters.bins();
  const Tallies tallies(bins);
  const auto observe = [=](ClosedRun& run, TallySums& sums) {
    WaitingTimes waits(bins);
    run.observe(waits);
    waits.record(tallies, sums);
  };
  return closed_study(parameters, tallies, observe, {waiting_times(parameters, tallies)}, "exponent");
}

}  // namespace

int main(int argc, char** argv) {
  StudyProgram program("waiting_time",
                       "Distribution of the time between two scatterings of a particle, in a closed chain");
  Parameters parameters;
  declare(program.options(), parameters, Role::effort);
  program.options().real(
      Role::output, "--tail-from", parameters.tail_from, {1, 1e6}, "1",
      "Lower cut of the tail, in flights of one cell at thermal speed; rounded down to an edge of the bins");
  return program.run(argc, argv, [&] { return waiting_time(parameters); });
}
