/// Ageing of the closed chain: the mean energy of a scatterer, and of a particle, against time from the
/// start.
///
/// The invariant density of the particles, exp(-u^2/2T)/|u|, cannot be normalised: ever more of them slow
/// down, and the energy that they lose heats the scatterers and the rest, logarithmically in time. The slope
/// against ln t is fitted to the last --fit-decades decades.
#include <algorithm>

#include "model/portable.hpp"
#include "observables/closed_chain_options.hpp"
#include "observables/log_times_options.hpp"
#include "program/replica_study.hpp"
#include "statistics/fit.hpp"

namespace {

using namespace lorentz;

double mean_scatterer_energy(const ClosedDynamics& chain) {
  const std::vector<double> scatterers = chain.scatterers();
  double sum = 0;
  for (const double U : scatterers) sum += 0.5 * U * U;
  return sum / static_cast<double>(scatterers.size());
}

Results summarise(const Records& records, const std::vector<double>& times, double fit_from) {
  const std::size_t size = times.size();
  const auto first =
      static_cast<std::size_t>(std::lower_bound(times.begin(), times.end(), fit_from) - times.begin());
  std::vector<double> log_times;
  for (const double time : times) log_times.push_back(portable::log(time));
  const Axis time{"time", "time", "Time since the start", times};
  return estimate(
      records,
      {{"scatterer_energy", "energy", "Mean kinetic energy of a scatterer", {time}},
       {"particle_energy", "energy", "Mean kinetic energy of a particle", {time}},
       {"log_slope", "energy", "Slope of scatterer_energy against ln t over the last --fit-decades decades"}},
      [&](std::span<const double> sums) {
        std::vector<double> values(sums.begin(), sums.begin() + static_cast<std::ptrdiff_t>(2 * size));
        values.push_back(
            fit_line(std::span(log_times).subspan(first), sums.subspan(first, size - first)).slope);
        return values;
      });
}

}  // namespace

int main(int argc, char** argv) {
  Program program("ageing", "Energy of the scatterers of a closed chain against time");
  ClosedChainOptions chain(program.options(), /*relaxation_time=*/0, /*observation_time=*/10'000);
  const LogTimesOptions log_times(program.options(), /*fit_decades=*/2);
  const ReplicaOptions replicas(program);
  return program.run(argc, argv, [&](Progress& progress) {
    chain.validate();
    const std::vector<double> times = log_times.times(chain.observation_time());
    const auto measure = [&](const Replica& replica) {
      ClosedReplica run(chain, replica);
      run.relax();
      std::vector<double> sums(2 * times.size());
      NoObserver nobody;
      for (std::size_t k = 0; k < times.size(); ++k) {
        run.observe_until(chain.relaxation_time() + times[k], nobody);
        const double scatterer = mean_scatterer_energy(run.chain());
        sums[k] = scatterer;
        sums[times.size() + k] =
            (run.chain().invariants().energy - scatterer * chain.chain().cells) / chain.chain().particles();
      }
      return run.record(std::move(sums));
    };
    const auto results = [&](const Records& records) {
      return summarise(records, times, log_times.fit_from(times.back()));
    };
    return replicas.run({measure, with_drift(results), "log_slope", RandomStream::description}, progress);
  });
}
