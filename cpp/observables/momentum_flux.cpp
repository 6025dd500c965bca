/// Momentum distribution F_N(p, x) of the particles in the stationary state of an open chain: crossings per
/// unit time and momentum at every bond, x = bond/N, so that the integral over a half line is the rate of
/// crossings. (The paper's plots are normalised to 1/2 instead.)
///
/// What a reservoir happened to inject in a bin, minus its known mean, is a control variate of the flux in
/// that bin, beside the numbers, momenta and energies of all bins (statistics/control_variates.hpp). The jump
/// at p = 0 is read off lines through the two bins on either side; the kurtosis of a half of F,
/// <p^4>/<p^2>^2, is 3 where that half is Gaussian.
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "observables/momentum_bins_options.hpp"
#include "observables/open_chain_options.hpp"
#include "observables/physics_options.hpp"
#include "program/replica_study.hpp"
#include "statistics/control_variates.hpp"
#include "statistics/range_tally.hpp"

namespace {

using namespace lorentz;

constexpr std::array powers{0, 2, 4};  // of |p| whose sums are kept

class Crossings {
 public:
  Crossings(const OpenChain& chain, const Window& window, const Bins& bins)
      : chain_(chain),
        window_(window),
        bins_(bins),
        counts_(bins.count() * bonds()),
        moments_(2, RangeTally<powers.size()>(bonds())),
        injected_(bins) {}

  void on_flight(const Path& path) {
    const Marks marks = marks_in(path, window_);
    const std::int64_t first = (marks.low + 1) / 2, last = marks.high / 2;  // bonds
    if (marks.low > marks.high || first > last) return;
    const std::size_t bin = bins_[path.velocity];
    const auto before = static_cast<std::int64_t>(bin * bonds());
    if (bin < bins_.count()) counts_.add(before + first, before + last, {1});
    const double square = path.velocity * path.velocity;
    moments_[path.rightwards() ? 1 : 0].add(first, last, {1, square, square * square});
  }

  void on_injection(End end, double, double u) {
    controls_.add(end, u);
    injected_.add(u);
  }

  /// Per unit time, bonds after bonds: crossings in every bin; sums of the powers to the left, then to the
  /// right; then injections by bin, minus their means, and the controls.
  std::vector<double> record() const {
    std::vector<double> values;
    const double duration = window_.end - window_.begin;
    const auto append = [&](const std::vector<double>& sums) {
      for (const double sum : sums) values.push_back(sum / duration);
    };
    append(counts_.sums());
    for (const auto& direction : moments_)
      for (std::size_t k = 0; k < powers.size(); ++k) append(direction.sums(k));
    for (std::size_t bin = 0; bin < bins_.count(); ++bin) {
      const bool right = bins_.edge(bin) >= 0;
      const double a = std::abs(bins_.edge(bin)), b = std::abs(bins_.edge(bin + 1));
      const Reservoir& source = right ? chain_.left : chain_.right;
      values.push_back(injected_.weights()[bin] -
                       duration * source.rate * source.probability(std::min(a, b), std::max(a, b)));
    }
    controls_.append_to(values, chain_, duration);
    return values;
  }

 private:
  std::size_t bonds() const { return std::size_t{chain_.cells} + 1; }

  OpenChain chain_;
  Window window_;
  Bins bins_;
  RangeTally<> counts_;                             // bin after bin
  std::vector<RangeTally<powers.size()>> moments_;  // to the left, to the right
  Histogram injected_;
  InjectionControls controls_;
};

/// The records without the injections by bin, everything corrected: every bin by what was injected in it too.
Records reduced(const Records& records, std::size_t bonds, std::size_t bins) {
  constexpr std::size_t shared = InjectionControls::count;
  const std::size_t moments = 2 * powers.size() * bonds;
  std::vector<std::vector<double>> rows(records.size());
  const auto append = [&](std::size_t first, std::size_t size, std::vector<std::size_t> own) {
    Records part(size + own.size() + shared);
    for (std::size_t replica = 0; replica < records.size(); ++replica) {
      const std::span<const double> row = records[replica];
      std::vector<double> values(row.begin() + static_cast<std::ptrdiff_t>(first),
                                 row.begin() + static_cast<std::ptrdiff_t>(first + size));
      for (const std::size_t control : own) values.push_back(row[control]);
      values.insert(values.end(), row.end() - shared, row.end());
      part.append(values);
    }
    const Records corrected = reduce_variance(part, own.size() + shared);
    for (std::size_t replica = 0; replica < records.size(); ++replica)
      rows[replica].insert(rows[replica].end(), corrected[replica].begin(),
                           corrected[replica].begin() + static_cast<std::ptrdiff_t>(size));
  };
  for (std::size_t bin = 0; bin < bins; ++bin) append(bin * bonds, bonds, {bins * bonds + moments + bin});
  append(bins * bonds, moments, {});

  Records result(rows.front().size());
  for (const std::vector<double>& row : rows) result.append(row);
  return result;
}

Results summarise(const Records& records, std::size_t bonds, const Bins& bins) {
  std::vector<double> numbers(bonds);
  std::iota(numbers.begin(), numbers.end(), 0.0);
  const Axis bond{"bond", "1", "Bond number; 0 and N are the openings", numbers};
  const Axis momentum{"momentum", "momentum", "Middle of the bin", bins.middles()};
  const Axis half{"half", "1", "Sign of p", {-1, 1}};
  const auto shapes = [&](std::span<const double> row) {
    const auto flux = [&](std::size_t at, std::size_t bin) { return row[bin * bonds + at] / bins.width(); };
    const auto moment = [&](std::size_t at, std::size_t side, std::size_t k) {
      return row[(bins.count() + side * powers.size() + k) * bonds + at];
    };
    std::vector<double> values;
    for (std::size_t at = 0; at < bonds; ++at)
      for (std::size_t bin = 0; bin < bins.count(); ++bin) values.push_back(flux(at, bin));
    const std::size_t zero = bins.count() / 2;
    for (std::size_t at = 0; at < bonds; ++at)
      values.push_back(1.5 * (flux(at, zero) - flux(at, zero - 1)) -
                       0.5 * (flux(at, zero + 1) - flux(at, zero - 2)));
    const auto by_half = [&](auto&& value) {
      for (std::size_t at = 0; at < bonds; ++at)
        for (const std::size_t side : {0, 1}) values.push_back(value(at, side));
    };
    by_half([&](std::size_t at, std::size_t side) { return moment(at, side, 0); });
    const auto mean = [&](std::size_t at, std::size_t side, std::size_t k) {
      const double crossings = moment(at, side, 0);
      return crossings > 0 ? moment(at, side, k) / crossings : std::numeric_limits<double>::quiet_NaN();
    };
    by_half([&](std::size_t at, std::size_t side) { return mean(at, side, 1); });
    by_half([&](std::size_t at, std::size_t side) {
      const double first = mean(at, side, 1);
      return mean(at, side, 2) / (first * first);
    });
    double total = 0;
    for (std::size_t at = 0; at < bonds; ++at) total += moment(at, 0, 0) + moment(at, 1, 0);
    values.push_back(total / static_cast<double>(bonds));
    return values;
  };
  Results results =
      estimate(reduced(records, bonds, bins.count()),
               {{"flux", "1/(time momentum)", "F_N, crossings per unit time and momentum", {bond, momentum}},
                {"jump", "1/(time momentum)", "F_N at p = 0+ minus p = 0-", {bond}},
                {"rate", "1/time", "Crossings by direction", {bond, half}},
                {"square", "momentum^2", "<p^2> by direction", {bond, half}},
                {"kurtosis", "1", "<p^4>/<p^2>^2 by direction; 3 for a Gaussian half", {bond, half}},
                {"crossings", "1/time", "Crossings of a bond, mean over bonds"}},
               shapes);
  const Results plain = estimate(
      records, {{"flux_plain", "1/(time momentum)", "F_N without control variates", {bond, momentum}}},
      [&](std::span<const double> row) {
        std::vector<double> values = shapes(row);
        values.resize(bonds * bins.count());
        return values;
      });
  results.push_back(plain.front());
  return results;
}

}  // namespace

int main(int argc, char** argv) {
  Program program("momentum_flux", "Momentum distribution of the particles in an open chain");
  const OpenChainOptions options(program.options(), {.cell_length = 0}, "warm", {{100}, {1000}});
  const MomentumBinsOptions bins(program.options(), 100, 60);
  const ReplicaOptions replicas(program);
  return program.run(argc, argv, [&](Progress& progress) {
    options.validate();
    bins.validate();
    const OpenChain chain = options.chain();
    require_fourth_powers(chain.left, chain.right);
    const Window window = options.window();
    const auto measure = [&](const Replica& replica) {
      return options.measure(replica, window, Crossings(chain, window, bins.bins()));
    };
    const auto results = [&](const Records& records) {
      return summarise(records, std::size_t{chain.cells} + 1, bins.bins());
    };
    return replicas.run({measure, results, "crossings", RandomStream::description}, progress);
  });
}
