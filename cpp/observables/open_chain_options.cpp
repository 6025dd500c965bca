#include "observables/open_chain_options.hpp"

#include <cmath>

#include "engine/open_start.hpp"
#include "observables/physics_options.hpp"
#include "program/errors.hpp"

namespace lorentz {

void OpenChainOptions::declare(Options& options) {
  add_scattering_options(options, chain_.cells, chain_.sigma, chain_.gamma, non_negative);
  options.real_or_word("--cell-length", chain_.cell_length, positive, "1/N", 0,
                       "Distance between scatterers");
  add_reservoir_options(options, chain_.left, chain_.right);
  options.choice("--start", start_, {"empty", "warm"},
                 "empty: no particles, scatterers at rest; warm: near the stationary state");
  if (!times_) return;
  options.scaled("--relaxation-time", times_->relaxation, non_negative, "Time before the measurement");
  options.scaled("--observation-time", times_->observation, positive, "Time of the measurement");
}

OpenChain OpenChainOptions::chain() const {
  OpenChain chain = chain_;
  if (chain.cell_length == 0) chain.cell_length = 1. / chain.cells;
  return chain;
}

Window OpenChainOptions::window() const {
  const double begin = times_.value().relaxation.at(chain_.cells);
  return {begin, begin + times_.value().observation.at(chain_.cells)};
}

void OpenChainOptions::validate(double end, const std::string& times) const {
  constexpr double most_particles = 1e9;
  const OpenChain open = chain();
  const auto [cold, hot] = std::minmax(open.left.temperature, open.right.temperature);
  const double rate = open.left.rate + open.right.rate;
  require_within(cold, 1e-300, 1e300, "--temperature-left, --temperature-right", "the lowest temperature");
  require_within(rate * end, 0, 1e15, "--nu-left, --nu-right, " + times, "the number of injected particles");
  require_representable({hot, open.cell_length, end, rate * end, flights_of_one_clock,
                         "--temperature-left, --temperature-right", times});
  require_within(hot * end, 1e-290, 1e300, "--temperature-left, --temperature-right, " + times,
                 "the temperature times the end of the run");
  if (rate > 0) {
    require_within(rate * cold, 1e-290, 1e300,
                   "--nu-left, --nu-right, --temperature-left, --temperature-right",
                   "the rate times the lowest temperature");
    require_within(rate * hot, 1e-290, 1e300,
                   "--nu-left, --nu-right, --temperature-left, --temperature-right",
                   "the rate times the highest temperature");
  }
  // Slow particles stay: a few dozen times as many as cross at thermal speed.
  const double stay = std::min(end, 50 * open.cell_length * open.cells / std::sqrt(cold));
  require_within(rate * stay, 0, most_particles, "--nu-left, --nu-right", "the number of particles inside");
}

void OpenChainOptions::validate() const {
  validate(window().end, "--relaxation-time plus --observation-time");
  require_within(window().end / (window().end - window().begin), 1, flights_of_one_clock,
                 "--relaxation-time, --observation-time",
                 "the end of the run over the time of the measurement");
}

PhasePoint OpenChainOptions::start(double age, const StreamKey& key) const {
  const OpenChain chain = this->chain();
  if (start_ == "empty") return empty_start(chain);
  return local_equilibrium_start(chain, chain.left, chain.right, age, key);
}

void InjectionControls::append_to(std::vector<double>& record, const OpenChain& chain,
                                  double duration) const {
  std::size_t i = 0;
  for (const Reservoir& reservoir : {chain.left, chain.right}) {
    const double injected = reservoir.rate * duration;
    for (const double each : {1.0, reservoir.mean_momentum(), reservoir.mean_energy()})
      record.push_back(sums_[i++] - injected * each);
  }
}

}  // namespace lorentz
