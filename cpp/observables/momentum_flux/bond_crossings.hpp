#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/path.hpp"
#include "model/open_chain.hpp"
#include "sampling/momentum_bins.hpp"
#include "sampling/stationarity.hpp"
#include "statistics/control_variates.hpp"
#include "statistics/histogram.hpp"
#include "statistics/range_tally.hpp"
#include "statistics/tally.hpp"

namespace lorentz {

/// Tallies of the crossings of the bonds of an open chain by momentum, with control variates for each bin.
struct BondTallies : StationaryTallies {
  static constexpr std::size_t powers = 3;  // of p whose sums are kept: 0, 2, 4

  Axis bond, momentum, half{"half", "1", "Sign of p", {-1, 1}};
  Tally crossings = tally("crossings", {momentum, bond}, "1/time", "Crossings of a bond in a bin of p");
  std::array<Tally, powers> sums{
      tally("crossings_by_direction", {half, bond}, "1/time", "Crossings of a bond"),
      tally("squares", {half, bond}, "momentum^2/time", "Sum of p^2 over crossings"),
      tally("fourth_powers", {half, bond}, "momentum^4/time", "Sum of p^4 over crossings")};
  Tally bin_injection = tally("bin_injection", {momentum}, "1", "Injected in a bin, minus its mean");

  BondTallies(std::size_t cells, const Bins& bins)
      : bond(numbered_axis("bond", "Bond number; 0 and N are the openings", cells + 1)),
        momentum(momentum_axis(bins)) {}

  std::size_t bonds() const { return bond.values.size(); }
};

/// Mean number of particles that a reservoir injects into a bin during the window [eq. 30].
inline double expected_injections(const OpenChain& chain, const Window& window, const Bins& bins,
                                  std::size_t bin) {
  const double a = std::abs(bins.edge(bin)), b = std::abs(bins.edge(bin + 1));
  const Reservoir& source = bins.edge(bin) >= 0 ? chain.left : chain.right;
  return (window.end - window.begin) * source.rate * source.probability(std::min(a, b), std::max(a, b));
}

/// Observer that fills BondTallies [eq. 25].
class BondCrossings {
 public:
  BondCrossings(const OpenChain& chain, const Window& window, const Bins& bins)
      : chain_(chain),
        window_(window),
        bins_(bins),
        bonds_(std::size_t{chain.cells} + 1),
        counts_(bins_.count() * bonds_),
        moments_(2, RangeTally<BondTallies::powers>(bonds_)),
        injected_(bins) {}

  [[gnu::always_inline]] void on_flight(const Path& path) {  // called once per event
    const Marks marks = marks_in(path, window_);
    const std::int64_t first = (marks.low + 1) / 2, last = marks.high / 2;  // bonds
    if (marks.low > marks.high || first > last) return;
    const std::size_t bin = bins_[path.velocity];
    const auto before = static_cast<std::int64_t>(bin * bonds_);
    if (bin < bins_.count()) counts_.add(before + first, before + last, {1});
    const double square = path.velocity * path.velocity;
    moments_[path.direction()].add(first, last, {1, square, square * square});
  }

  void on_injection(End, double, double u) { injected_.add(u); }

  void record(const BondTallies& tallies, TallySums& sums) const {
    const double duration = window_.end - window_.begin;
    const auto rate = [duration](double sum) { return sum / duration; };
    std::ranges::transform(counts_.sums(), sums[tallies.crossings].begin(), rate);
    for (const Direction side : {leftwards, rightwards})
      for (std::size_t k = 0; k < BondTallies::powers; ++k)
        std::ranges::transform(moments_[side].sums(k), sums[tallies.sums[k].row(side)].begin(), rate);
    for (std::size_t bin = 0; bin < bins_.count(); ++bin)
      sums[tallies.bin_injection][bin] =
          injected_.weights()[bin] - expected_injections(chain_, window_, bins_, bin);
  }

 private:
  OpenChain chain_;
  Window window_;
  Bins bins_;
  std::size_t bonds_;
  RangeTally<> counts_;                                   // [bin, bond]
  std::vector<RangeTally<BondTallies::powers>> moments_;  // to the left, to the right
  Histogram injected_;
};

/// Regressions of the flux in a bin on the injections into the same bin, for bins with enough injections to
/// determine the coefficient.
inline std::vector<Regression> regressions_by_bin(const BondTallies& tallies, const OpenChain& chain,
                                                  const Window& window, const Bins& bins) {
  constexpr double enough = 10;  // injections per replica
  std::vector<Regression> regressions;
  for (std::size_t bin = 0; bin < bins.count(); ++bin) {
    if (expected_injections(chain, window, bins, bin) < enough) continue;
    regressions.push_back(
        {columns_of({tallies.crossings.row(bin)}), columns_of({tallies.bin_injection.row(bin)})});
  }
  return regressions;
}

}  // namespace lorentz
