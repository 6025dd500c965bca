/// Profiles of an open chain in its stationary state, averaged over a window of time: temperatures of
/// scatterers and particles [eq. 26], density, rates of arrivals, currents [eq. 25], and the momentum
/// distribution of the end scatterers.
///
/// The temperature of the particles is <p^2>/m over the arrivals at a scatterer, that of the flux, not of the
/// density. The density includes slow particles, whose number grows logarithmically in time [eq. 24], and
/// thus depends on the window. All means are corrected by the injection controls [eq. 30, eq. 33].
/// Differences, deviations and slopes are separate quantities with their own errors, because the noise of
/// neighbouring cells and bonds is correlated. The bulk of the density is a line through the middle half of
/// the chain.
#include "observables/steady_profile/cell_profile.hpp"
#include "observables/steady_profile/profile.hpp"
#include "sampling/stationarity.hpp"
#include "statistics/control_variates.hpp"

namespace {

using namespace lorentz;

struct Parameters : StationaryParameters {
  MomentumBinParameters bins;
};

/// Quantities of a mean record.
struct Profile {
  TallyMeans mean;
  const CellTallies& tallies;

  Values temperature() const { return mean_of(tallies.temperature)(mean); }
  Values particle_temperature() const {
    const auto of = [&](Tally tally, std::size_t cell) {
      return mean[tally.row(rightwards)][cell] + mean[tally.row(leftwards)][cell];
    };
    Values values;
    for (std::size_t cell = 0; cell < tallies.cell.values.size(); ++cell)
      values.push_back(of(tallies.arriving_squares, cell) / of(tallies.arrivals, cell));
    return values;
  }
  Values rate(Direction direction) const { return mean_of(tallies.arrivals.row(direction))(mean); }
  Values particle_current() const { return mean_of(tallies.particle_current)(mean); }
  Values energy_current() const { return mean_of(tallies.energy_current)(mean); }
};

Group profiles(const CellTallies& tallies, double bin_width) {
  const std::vector<Axis> cell{tallies.cell}, bond{tallies.bond}, end{tallies.end};
  const Columns measured =
      columns_of({tallies.temperature, tallies.density, tallies.arrivals, tallies.arriving_squares,
                  tallies.particle_current, tallies.energy_current, tallies.end_momentum});
  Group group([=](const Records& records) {
    return reduce_variance(records, {{measured, columns_of({tallies.injection})}});
  });
  const auto of = [&](auto&& formula) {
    return [=](TallyMeans mean) { return formula(Profile{mean, tallies}); };
  };
  const auto density = [](const Profile& profile) {
    return DensityProfile(profile.mean[profile.tallies.density]);
  };

  group.quantity(tallies, tallies.temperature);
  group.quantity("temperature_particle", cell, "temperature", "<p^2>/m over the arrivals at the scatterer",
                 of([](const Profile& profile) { return profile.particle_temperature(); }));
  group.quantity("temperature_difference", cell, "temperature",
                 "That of the scatterer minus that of the particles", of([](const Profile& profile) {
                   return difference(profile.temperature(), profile.particle_temperature());
                 }));
  group.quantity(tallies, tallies.density);
  group.quantity("density_slope", "1",
                 "Of the line through the middle half, over the chain and relative to its mean",
                 of([=](const Profile& profile) { return density(profile).slope(); }));
  group.quantity("density_excess", end, "1", "Density of an end cell over that line, minus 1",
                 of([=](const Profile& profile) { return density(profile).excess(); }));
  group.quantity("rate_right", cell, "1/time", "Arrivals at the scatterer to the right",
                 of([](const Profile& profile) { return profile.rate(rightwards); }));
  group.quantity("rate_left", cell, "1/time", "Arrivals at the scatterer to the left",
                 of([](const Profile& profile) { return profile.rate(leftwards); }));
  group.quantity("rate_right_deviation", cell, "1/time", "rate_right minus a straight line through it",
                 of([](const Profile& profile) { return minus_line(profile.rate(rightwards)); }));
  group.quantity("rate_left_deviation", cell, "1/time", "rate_left minus a straight line through it",
                 of([](const Profile& profile) { return minus_line(profile.rate(leftwards)); }));
  group.quantity(tallies, tallies.particle_current);
  group.quantity(tallies, tallies.energy_current);
  group.quantity("energy_current_mean", "energy/time", "Mean of J_U over the bonds",
                 of([](const Profile& profile) { return average(profile.energy_current()); }));
  group.quantity("particle_current_deviation", bond, "1/time", "J_n minus its mean over the bonds",
                 of([](const Profile& profile) { return minus_mean(profile.particle_current()); }));
  group.quantity("scatterer_density", {tallies.end, tallies.momentum}, "1/momentum",
                 "Probability density of P/sqrt(M)", mean_of(tallies.end_momentum, bin_width));
  return group;
}

Study steady_profile(const Parameters& parameters) {
  validate(parameters);
  validate(parameters.bins);
  const OpenChain chain = parameters.chain();
  const Window window = parameters.window();
  const Bins bins = parameters.bins.bins();
  const CellTallies tallies(chain.cells, bins);
  return stationary_study(
      parameters, tallies, [=] { return CellProfile(chain, window, bins); },
      {profiles(tallies, bins.width())}, "temperature_scatterer");
}

}  // namespace

int main(int argc, char** argv) {
  StudyProgram program("steady_profile", "Profiles of an open chain in its stationary state");
  Parameters parameters;
  declare(program.options(), parameters);
  declare(program.options(), parameters.bins);
  return program.run(argc, argv, [&] { return steady_profile(parameters); });
}
