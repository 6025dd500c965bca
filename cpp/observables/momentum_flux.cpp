/// Momentum distribution F_N(p, x) of the particles in the stationary state of an open chain: crossings per
/// unit time and momentum at every bond, x = bond/N, so that the integral over a half line is the rate of
/// crossings. (The paper's plots are normalised to 1/2 instead.)
///
/// What a reservoir happened to inject in a bin, minus its known mean, is a control variate of the flux in
/// that bin, as some particles cross bonds before they scatter; rates and moments have the numbers, momenta
/// and energies that are injected in all. Either is used if it makes its quantities scatter less on average
/// (statistics/control_variates.hpp). The jump at p = 0 is read off lines through the two bins on either
/// side; the kurtosis of a half of F, <p^4>/<p^2>^2, is 3 where that half is Gaussian.
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>

#include "observables/momentum_bins_options.hpp"
#include "observables/open_chain_options.hpp"
#include "observables/physics_options.hpp"
#include "program/replica_study.hpp"
#include "statistics/control_variates.hpp"
#include "statistics/range_tally.hpp"

namespace {

using namespace lorentz;

constexpr std::array powers{0, 2, 4};  // of |p| whose sums are kept

/// Particles that a reservoir injects into a bin in the window, on average.
double expected_injections(const OpenChain& chain, const Window& window, const Bins& bins, std::size_t bin) {
  const double a = std::abs(bins.edge(bin)), b = std::abs(bins.edge(bin + 1));
  const Reservoir& source = bins.edge(bin) >= 0 ? chain.left : chain.right;
  return (window.end - window.begin) * source.rate * source.probability(std::min(a, b), std::max(a, b));
}

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
    for (std::size_t bin = 0; bin < bins_.count(); ++bin)
      values.push_back(injected_.weights()[bin] - expected_injections(chain_, window_, bins_, bin));
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

using Expected = std::function<double(std::size_t bin)>;  // injections in a replica

/// Columns of the records: the bonds of every bin, those of every moment, then the controls.
struct Layout {
  std::size_t bonds, bins;

  std::size_t moments() const { return 2 * powers.size(); }
  std::size_t own_control(std::size_t bin) const { return (bins + moments()) * bonds + bin; }
  std::size_t shared_controls() const { return own_control(bins); }
};

/// Records of which some columns are corrected by some controls, where that makes them scatter less.
class Correction {
 public:
  explicit Correction(const Records& records) : plain_(records) {
    for (std::size_t replica = 0; replica < records.size(); ++replica)
      rows_.emplace_back(records[replica].begin(), records[replica].end());
  }

  /// A column that the controls determine, such as what enters at an opening, stays as it is: it would come
  /// out as its known mean, which is no measurement, with an error of 0.
  void regress(std::size_t first, std::size_t columns, std::size_t first_control, std::size_t controls) {
    const auto from = [](std::vector<double>& row, std::size_t column) {
      return row.begin() + static_cast<std::ptrdiff_t>(column);
    };
    Records part(columns + controls);
    for (std::vector<double>& row : rows_) {
      std::vector<double> values(from(row, first), from(row, first + columns));
      values.insert(values.end(), from(row, first_control), from(row, first_control + controls));
      part.append(values);
    }
    const std::optional<Records> corrected = regress_out(part, controls);
    if (!corrected) return;
    for (std::size_t column = 0; column < columns; ++column) {
      if (variance_ratio(*corrected, part, column, 1) < 1e-12) continue;
      for (std::size_t replica = 0; replica < rows_.size(); ++replica)
        rows_[replica][first + column] = (*corrected)[replica][column];
    }
  }

  ReducedRecords best() const {
    Records corrected(plain_.width());
    for (const std::vector<double>& row : rows_) corrected.append(row);
    const bool helps = variance_ratio(corrected, plain_, 0, plain_.width()) < 1;
    return {helps ? corrected : plain_, helps};
  }

 private:
  const Records& plain_;
  std::vector<std::vector<double>> rows_;
};

/// Of the bins into which so many particles are injected that the replicas tell a coefficient.
ReducedRecords with_corrected_bins(const Records& records, const Layout& layout, const Expected& expected) {
  constexpr double enough = 10;  // per replica
  Correction correction(records);
  for (std::size_t bin = 0; bin < layout.bins; ++bin)
    if (expected(bin) >= enough)
      correction.regress(bin * layout.bonds, layout.bonds, layout.own_control(bin), 1);
  return correction.best();
}

ReducedRecords with_corrected_moments(const Records& records, const Layout& layout) {
  Correction correction(records);
  correction.regress(layout.bins * layout.bonds, layout.moments() * layout.bonds, layout.shared_controls(),
                     InjectionControls::count);
  return correction.best();
}

/// Reads the flux and its shape off a mean record.
class Shape {
 public:
  Shape(std::span<const double> row, const Layout& layout, const Bins& bins)
      : row_(row), layout_(layout), bins_(bins) {}

  std::vector<double> flux() const {
    return by_bond(bins_.count(), [&](std::size_t bond, std::size_t bin) { return flux(bond, bin); });
  }

  /// At p = 0, from lines through the two bins on either side.
  std::vector<double> jump() const {
    const std::size_t zero = bins_.count() / 2;
    return by_bond(1, [&](std::size_t bond, std::size_t) {
      return 1.5 * (flux(bond, zero) - flux(bond, zero - 1)) -
             0.5 * (flux(bond, zero + 1) - flux(bond, zero - 2));
    });
  }

  std::vector<double> rate() const {
    return by_bond(2, [&](std::size_t bond, std::size_t side) { return sum(bond, side, 0); });
  }

  std::vector<double> square() const {
    return by_bond(2, [&](std::size_t bond, std::size_t side) { return mean(bond, side, 1); });
  }

  std::vector<double> kurtosis() const {
    return by_bond(2, [&](std::size_t bond, std::size_t side) {
      const double square = mean(bond, side, 1);
      return mean(bond, side, 2) / (square * square);
    });
  }

  /// Mean over the bonds.
  double crossings() const {
    const std::vector<double> rates = rate();
    return std::accumulate(rates.begin(), rates.end(), 0.0) / static_cast<double>(layout_.bonds);
  }

 private:
  double flux(std::size_t bond, std::size_t bin) const {
    return row_[bin * layout_.bonds + bond] / bins_.width();
  }
  double sum(std::size_t bond, std::size_t side, std::size_t k) const {
    return row_[(bins_.count() + side * powers.size() + k) * layout_.bonds + bond];
  }
  double mean(std::size_t bond, std::size_t side, std::size_t k) const {
    const double crossings = sum(bond, side, 0);
    return crossings > 0 ? sum(bond, side, k) / crossings : std::numeric_limits<double>::quiet_NaN();
  }

  template <class Value>
  std::vector<double> by_bond(std::size_t inner, Value&& value) const {
    std::vector<double> values;
    for (std::size_t bond = 0; bond < layout_.bonds; ++bond)
      for (std::size_t i = 0; i < inner; ++i) values.push_back(value(bond, i));
    return values;
  }

  std::span<const double> row_;
  Layout layout_;
  Bins bins_;
};

std::vector<double> joined(std::initializer_list<std::vector<double>> parts) {
  std::vector<double> values;
  for (const std::vector<double>& part : parts) values.insert(values.end(), part.begin(), part.end());
  return values;
}

Results summarise(const Records& records, std::size_t bonds, const Bins& bins, const Expected& expected) {
  const Layout layout{bonds, bins.count()};
  std::vector<double> numbers(bonds);
  std::iota(numbers.begin(), numbers.end(), 0.0);
  const Axis bond{"bond", "1", "Bond number; 0 and N are the openings", numbers};
  const Axis momentum{"momentum", "momentum", "Middle of the bin", bins.middles()};
  const Axis half{"half", "1", "Sign of p", {-1, 1}};
  const std::string flux_units = "1/(time momentum)";
  const auto shape = [&](std::span<const double> row) { return Shape(row, layout, bins); };

  Results results =
      estimate(with_corrected_bins(records, layout, expected),
               {{"flux", flux_units, "F_N, crossings per unit time and momentum", {bond, momentum}},
                {"jump", flux_units, "F_N at p = 0+ minus p = 0-", {bond}}},
               [&](std::span<const double> row) { return joined({shape(row).flux(), shape(row).jump()}); });
  const auto append = [&](Results&& more) {
    for (Quantity& quantity : more) results.push_back(std::move(quantity));
  };
  append(estimate(with_corrected_moments(records, layout),
                  {{"rate", "1/time", "Crossings by direction", {bond, half}},
                   {"square", "momentum^2", "<p^2> by direction", {bond, half}},
                   {"kurtosis", "1", "<p^4>/<p^2>^2 by direction; 3 for a Gaussian half", {bond, half}},
                   {"crossings", "1/time", "Crossings of a bond, mean over bonds"}},
                  [&](std::span<const double> row) {
                    const Shape of = shape(row);
                    return joined({of.rate(), of.square(), of.kurtosis(), {of.crossings()}});
                  }));
  append(estimate(records, {{"flux_plain", flux_units, "F_N without control variates", {bond, momentum}}},
                  [&](std::span<const double> row) { return shape(row).flux(); }));
  return results;
}

}  // namespace

int main(int argc, char** argv) {
  Program program("momentum_flux", "Momentum distribution of the particles in an open chain");
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
    require_fourth_powers(chain.left, chain.right);
    const Window window = options.window();
    const auto measure = [&](const Replica& replica) {
      return options.measure(replica, window, Crossings(chain, window, bins.bins()));
    };
    const auto results = [&](const Records& records) {
      return summarise(records, std::size_t{chain.cells} + 1, bins.bins(),
                       [&](std::size_t bin) { return expected_injections(chain, window, bins.bins(), bin); });
    };
    return replicas.run({measure, results, "crossings", RandomStream::description}, progress);
  });
}
