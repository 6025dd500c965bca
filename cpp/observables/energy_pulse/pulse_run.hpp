#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "engine/pair.hpp"
#include "model/phase_point.hpp"
#include "program/options.hpp"
#include "program/study.hpp"
#include "sampling/chain_parameters.hpp"

namespace lorentz {

/// Parameters of an energy pulse in a closed chain. Defaults: figure 9a of the paper.
struct PulseParameters {
  ClosedChainParameters ring{.scattering = {.cells = 101}, .particles_per_cell = 50};
  double energy = 5000;         // per degree of freedom, T = 2 energy
  double pulse_energy = 50000;  // per degree of freedom in the pulse
  std::uint32_t pulse_cells = 1;
  std::optional<double> scatterer_temperature{};  // none: that of the particles
  double relaxation_time = 0;
  std::vector<double> times{0.01, 0.02, 0.03, 0.04, 0.05,
                            0.06, 0.08, 0.1,  0.12};  // before the peaks meet on the ring
  std::uint32_t pairs_per_replica = 16;
};

void declare(Options& options, PulseParameters& parameters);

/// Throws UsageError if options that are valid one by one exclude each other.
void validate(const PulseParameters& parameters);

/// Pair of trajectories of a closed chain, with the pulse and without, that start from one state and use
/// common random numbers [eq. 43, 44].
class PulseRun {
 public:
  using Heartbeat = std::function<void(double)>;

  /// share: false simulates both trajectories in full. Energy differences then have other rounding errors.
  PulseRun(const PulseParameters& parameters, const StreamKey& key, const Heartbeat& heartbeat,
           bool share = true);

  /// Advances both trajectories to a time after the pulse.
  void run(double time);

  /// Energy of every cell with the pulse minus that without, at the current time [eq. 44].
  std::vector<double> energy_difference() const;

  double injected_energy() const { return injected_energy_; }

  /// |Sum of energy_difference() minus the injected energy| over the total energy: 0 up to rounding.
  double conservation_error(const std::vector<double>& energy_difference) const;

  std::uint64_t events() const { return relaxation_events_ + pair_.events(); }

 private:
  struct Start {
    PhasePoint plain, pulsed;
    std::uint64_t events = 0;  // of the relaxation
  };
  static Start start(const PulseParameters& parameters, const StreamKey& key, const Heartbeat& heartbeat);
  PulseRun(const PulseParameters& parameters, const StreamKey& key, Heartbeat heartbeat, bool share,
           const Start& start);

  ClosedChain chain_;
  Heartbeat heartbeat_;
  std::uint64_t relaxation_events_;
  PairDynamics pair_;
  double time_ = 0;
  double injected_energy_, total_energy_;
};

}  // namespace lorentz
