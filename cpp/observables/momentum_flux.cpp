/// Momentum distribution F_N(p, x) of the particles in the stationary state of an open chain [eq. 25]:
/// crossings per unit time and momentum at every bond, x = bond/N. The integral over a half line is the rate
/// of crossings; the paper's plots are normalised to 1/2 instead.
///
/// Control variates [eq. 30, eq. 33]: for the flux in a bin, the number of particles injected into it, minus
/// the known mean, because some particles cross bonds before they scatter; for rates and moments, numbers,
/// momenta and energies injected in all. Each group is used if it reduces the variance on average. The jump
/// at p = 0 is extrapolated by lines through two bins on either side. The kurtosis of one half of F,
/// <p^4>/<p^2>^2, is 3 for a Gaussian half.
#include <limits>
#include <numeric>

#include "observables/momentum_flux/bond_crossings.hpp"
#include "sampling/momentum_bins.hpp"
#include "sampling/stationarity.hpp"
#include "statistics/control_variates.hpp"

namespace {

using namespace lorentz;

struct Parameters : StationaryParameters {
  MomentumBinParameters bins;
};

/// F_N and its moments by direction, from a mean record.
struct Reading {
  TallyMeans mean;
  const BondTallies& tallies;
  double bin_width;

  double flux(std::size_t bond, std::size_t bin) const {
    return mean[tallies.crossings.row(bin)][bond] / bin_width;
  }
  /// Jump of F_N at p = 0, from lines through the two bins on either side; NaN with fewer bins.
  double jump(std::size_t bond, std::size_t) const {
    if (tallies.momentum.values.size() < 4) return std::numeric_limits<double>::quiet_NaN();
    const std::size_t zero = tallies.momentum.values.size() / 2;
    return 1.5 * (flux(bond, zero) - flux(bond, zero - 1)) -
           0.5 * (flux(bond, zero + 1) - flux(bond, zero - 2));
  }
  double rate(std::size_t bond, std::size_t side) const { return mean[tallies.sums[0].row(side)][bond]; }
  double average(std::size_t k, std::size_t bond, std::size_t side) const {
    const double crossings = rate(bond, side), sum = mean[tallies.sums[k].row(side)][bond];
    return crossings > 0 ? sum / crossings : std::numeric_limits<double>::quiet_NaN();
  }
  double square(std::size_t bond, std::size_t side) const { return average(1, bond, side); }
  double kurtosis(std::size_t bond, std::size_t side) const {
    return average(2, bond, side) / (square(bond, side) * square(bond, side));
  }

  /// Array [bond, inner] of values.
  std::vector<double> all(std::size_t inner, double (Reading::*value)(std::size_t, std::size_t) const) const {
    std::vector<double> values;
    for (std::size_t bond = 0; bond < tallies.bonds(); ++bond)
      for (std::size_t i = 0; i < inner; ++i) values.push_back((this->*value)(bond, i));
    return values;
  }
};

/// Crossings in all replicas from which a kurtosis and its error are estimated: of fewer, few have most of
/// the sum of p^4, and the jackknife's error is too small.
constexpr double enough_for_kurtosis = 1000;

std::vector<Group> flux_and_shape(const BondTallies& tallies, double bin_width, double duration,
                                  const std::vector<Regression>& by_bin) {
  const std::string units = "1/(time momentum)";
  const std::vector<Axis> bonds{tallies.bond}, bins{tallies.bond, tallies.momentum},
      halves{tallies.bond, tallies.half};
  const auto all = [=](const std::vector<Axis>& axes,
                       double (Reading::*value)(std::size_t, std::size_t) const) {
    const std::size_t inner = axes.size() > 1 ? axes[1].values.size() : 1;
    return [=](TallyMeans mean) { return Reading{mean, tallies, bin_width}.all(inner, value); };
  };

  const Regression by_all{columns_of({tallies.sums[0], tallies.sums[1], tallies.sums[2]}),
                          columns_of({tallies.injection})};
  Group fluxes([=](const Records& records) { return reduce_variance(records, by_bin); });
  Group moments([=](const Records& records) { return reduce_variance(records, {by_all}); });
  fluxes.quantity("flux", bins, units, "F_N, crossings per unit time and momentum",
                  all(bins, &Reading::flux));
  fluxes.quantity("jump", bonds, units, "F_N at p = 0+ minus p = 0-", all(bonds, &Reading::jump));
  moments.quantity("square", halves, "momentum^2", "<p^2> by direction", all(halves, &Reading::square));
  moments.quantities(
      {{"kurtosis", "1", "<p^4>/<p^2>^2 by direction, of 1000 crossings or more; 3 for a Gaussian half",
        halves}},
      [=, rates = all(halves, &Reading::rate),
       kurtosis = all(halves, &Reading::kurtosis)](const Records& records) {
        std::vector<double> crossings = rates(records.mean());
        for (double& number : crossings) number *= duration * static_cast<double>(records.size());
        return [=](TallyMeans mean) {
          std::vector<double> values = kurtosis(mean);
          for (std::size_t i = 0; i < values.size(); ++i)
            if (crossings[i] < enough_for_kurtosis) values[i] = std::numeric_limits<double>::quiet_NaN();
          return values;
        };
      });
  moments.quantity("crossings", "1/time", "Crossings of a bond, mean over bonds",
                   [=, rates = all(halves, &Reading::rate)](TallyMeans mean) {
                     const std::vector<double> by_half = rates(mean);
                     return std::accumulate(by_half.begin(), by_half.end(), 0.0) /
                            static_cast<double>(tallies.bonds());
                   });
  return {fluxes, moments};
}

Study momentum_flux(const Parameters& parameters) {
  validate(parameters);
  validate(parameters.bins);
  const OpenChain chain = parameters.chain();
  const Window window = parameters.window();
  const Bins bins = parameters.bins.bins();
  const BondTallies tallies(chain.cells, bins);
  return stationary_study(
      parameters, tallies, [=] { return BondCrossings(chain, window, bins); },
      flux_and_shape(tallies, bins.width(), window.end - window.begin,
                     regressions_by_bin(tallies, chain, window, bins)),
      "crossings");
}

}  // namespace

int main(int argc, char** argv) {
  StudyProgram program("momentum_flux", "Momentum distribution of the particles in an open chain");
  Parameters parameters;
  declare(program.options(), parameters);
  declare(program.options(), parameters.bins);
  return program.run(argc, argv, [&] { return momentum_flux(parameters); });
}
