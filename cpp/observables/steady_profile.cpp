/// Profiles of an open chain in its stationary state, averaged over a window of time: temperatures of
/// scatterers and particles [eq. 27], density, rates of arrivals, currents [eq. 26], and the momentum
/// distribution of the end scatterers.
///
/// The temperature of the particles is <p^2>/m over the arrivals at a scatterer, that of the flux, not of the
/// density. The density includes slow particles, whose number grows logarithmically in time [eq. 25], and
/// thus depends on the window. All means are corrected by the injection controls [eq. 31, 34]. Differences,
/// deviations and slopes are separate quantities with their own errors, because the noise of neighbouring
/// cells and bonds is correlated. The bulk of the density is a line through the middle half of the chain.
#include <functional>

#include "program/study.hpp"
#include "runs/cell_profile.hpp"
#include "runs/open_run.hpp"
#include "statistics/profile.hpp"

namespace {

using namespace lorentz;

constexpr std::size_t right = 0, left = 1;  // directions

struct Parameters : OpenParameters {
  WindowParameters times;
  MomentumBinParameters bins;
};

/// Quantities of a mean record.
struct Profile {
  RecordView mean;
  const CellTallies& tallies;

  Values temperature() const { return {mean[tallies.temperature].begin(), mean[tallies.temperature].end()}; }
  Values particle_temperature() const {
    return combined(tallies.arrivals.size / 2, [this](std::size_t i, std::size_t j) {
      return (mean[tallies.arriving_squares][i] + mean[tallies.arriving_squares][j]) /
             (mean[tallies.arrivals][i] + mean[tallies.arrivals][j]);
    });
  }
  Values rate(std::size_t direction) const {
    const auto both = mean[tallies.arrivals];
    const auto one = both.subspan(direction * both.size() / 2, both.size() / 2);
    return {one.begin(), one.end()};
  }
  Values particle_current() const {
    return combined(tallies.crossings.size / 2, [this](std::size_t i, std::size_t j) {
      return mean[tallies.crossings][i] - mean[tallies.crossings][j];
    });
  }
  Values energy_current() const {
    return combined(tallies.crossings.size / 2, [this](std::size_t i, std::size_t j) {
      return 0.5 * (mean[tallies.crossing_squares][i] - mean[tallies.crossing_squares][j]);
    });
  }

 private:
  /// Values computed from the columns of both directions.
  template <class Value>
  static Values combined(std::size_t size, const Value& value) {
    Values values;
    for (std::size_t i = 0; i < size; ++i) values.push_back(value(i, size + i));
    return values;
  }
};

Estimator profiles(const CellTallies& tallies, double bin_width) {
  const std::vector<Axis> cell{tallies.cell}, bond{tallies.bond}, end{tallies.end};
  Formulas<Profile> formulas([=](RecordView mean) { return Profile{mean, tallies}; });
  const auto density = [=](const Profile& profile) { return DensityProfile(profile.mean[tallies.density]); };
  using std::mem_fn;

  formulas.quantity("temperature_scatterer", cell, "temperature", "Time average of P^2/M",
                    mem_fn(&Profile::temperature));
  formulas.quantity("temperature_particle", cell, "temperature", "<p^2>/m over the arrivals at the scatterer",
                    mem_fn(&Profile::particle_temperature));
  formulas.quantity("temperature_difference", cell, "temperature",
                    "That of the scatterer minus that of the particles", [](const Profile& profile) {
                      return difference(profile.temperature(), profile.particle_temperature());
                    });
  formulas.quantity("density", cell, "1", "Mean number of particles in the cell, frozen ones included",
                    [=](const Profile& profile) { return mean_of(tallies.density)(profile.mean); });
  formulas.quantity("density_slope", "1",
                    "Of the line through the middle half, over the chain and relative to its mean",
                    [=](const Profile& profile) { return density(profile).slope(); });
  formulas.quantity("density_excess", end, "1", "Density of an end cell over that line, minus 1",
                    [=](const Profile& profile) { return density(profile).excess(); });
  formulas.quantity("rate_right", cell, "1/time", "Arrivals at the scatterer to the right",
                    [](const Profile& profile) { return profile.rate(right); });
  formulas.quantity("rate_left", cell, "1/time", "Arrivals at the scatterer to the left",
                    [](const Profile& profile) { return profile.rate(left); });
  formulas.quantity("rate_right_deviation", cell, "1/time", "rate_right minus a straight line through it",
                    [](const Profile& profile) { return minus_line(profile.rate(right)); });
  formulas.quantity("rate_left_deviation", cell, "1/time", "rate_left minus a straight line through it",
                    [](const Profile& profile) { return minus_line(profile.rate(left)); });
  formulas.quantity("particle_current", bond, "1/time", "J_n, positive to the right",
                    mem_fn(&Profile::particle_current));
  formulas.quantity("energy_current", bond, "energy/time", "J_U, positive to the right",
                    mem_fn(&Profile::energy_current));
  formulas.quantity("particle_current_mean", "1/time", "Mean of J_n over the bonds",
                    [](const Profile& profile) { return average(profile.particle_current()); });
  formulas.quantity("energy_current_mean", "energy/time", "Mean of J_U over the bonds",
                    [](const Profile& profile) { return average(profile.energy_current()); });
  formulas.quantity("particle_current_deviation", bond, "1/time", "J_n minus its mean over the bonds",
                    [](const Profile& profile) { return minus_mean(profile.particle_current()); });
  formulas.quantity("energy_current_deviation", bond, "energy/time", "J_U minus its mean over the bonds",
                    [](const Profile& profile) { return minus_mean(profile.energy_current()); });
  formulas.quantity(
      "scatterer_density", {tallies.end, tallies.momentum}, "1/momentum", "Probability density of P/sqrt(M)",
      [=](const Profile& profile) { return mean_of(tallies.end_momentum, bin_width)(profile.mean); });
  const Columns measured =
      columns_of({tallies.temperature, tallies.density, tallies.arrivals, tallies.arriving_squares,
                  tallies.crossings, tallies.crossing_squares, tallies.end_momentum});
  return formulas.estimator([=](const Records& records) {
    return reduce_variance(records, {{measured, columns_of({tallies.injection})}});
  });
}

Study steady_profile(const Parameters& parameters) {
  validate(parameters, parameters.times);
  validate(parameters.bins);
  const OpenChain chain = parameters.chain();
  const Window window = parameters.times.window(chain.cells);
  const Bins bins = parameters.bins.bins();
  const CellTallies tallies(chain.cells, bins);
  const auto measure = [=](const Replica& replica, Record& record) {
    OpenRun run(parameters, window, replica);
    run.observe(CellProfile(chain, window, bins)).record(tallies, record);
    return run.events();
  };
  return {.tallies = tallies,
          .measure = measure,
          .estimators = {profiles(tallies, bins.width())},
          .target = "energy_current_mean"};
}

}  // namespace

int main(int argc, char** argv) {
  StudyProgram program("steady_profile", "Profiles of an open chain in its stationary state");
  Parameters parameters;
  declare(program.options(), parameters);
  declare(program.options(), parameters.times);
  declare(program.options(), parameters.bins);
  return program.run(argc, argv, [&] { return steady_profile(parameters); });
}
