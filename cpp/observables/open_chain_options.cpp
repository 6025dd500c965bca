#include "observables/open_chain_options.hpp"

#include <cmath>

#include "engine/open_start.hpp"
#include "observables/physics_options.hpp"
#include "program/errors.hpp"

namespace lorentz {

OpenChainOptions::OpenChainOptions(Options& options, const OpenChain& chain, const std::string& start)
    : chain_(chain), start_(start) {
  add_scattering_options(options, chain_.cells, chain_.sigma, chain_.gamma, non_negative);
  options.real_or_word("--cell-length", chain_.cell_length, positive, "1/N", 0,
                       "Distance between scatterers");
  add_reservoir_options(options, chain_.left, chain_.right);
  options.choice("--start", start_, {"empty", "warm"},
                 "empty: no particles, scatterers at rest; warm: near the stationary state");
}

OpenChainOptions::OpenChainOptions(Options& options, const OpenChain& chain, const std::string& start,
                                   Times times)
    : OpenChainOptions(options, chain, start) {
  times_ = times;
  options.scaled("--relaxation-time", times_.relaxation, non_negative, "Time before the measurement");
  options.scaled("--observation-time", times_.observation, positive, "Time of the measurement");
}

OpenChain OpenChainOptions::chain() const {
  OpenChain chain = chain_;
  if (chain.cell_length == 0) chain.cell_length = 1. / chain.cells;
  return chain;
}

Window OpenChainOptions::window() const {
  const double begin = times_.relaxation.at(chain_.cells);
  return {begin, begin + times_.observation.at(chain_.cells)};
}

void OpenChainOptions::validate() const {
  if (!std::isfinite(window().end))
    throw UsageError("--relaxation-time plus --observation-time overflows. Choose shorter times.");
}

PhasePoint OpenChainOptions::start(double age, std::uint64_t seed, std::uint64_t replica) const {
  const OpenChain chain = this->chain();
  if (start_ == "empty") return empty_start(chain);
  return local_equilibrium_start(chain, chain.left, chain.right, age, seed, replica);
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
