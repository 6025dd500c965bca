#pragma once

#include "engine/initial_state.hpp"
#include "engine/simulate.hpp"
#include "program/options.hpp"
#include "program/replicas.hpp"

namespace lorentz {

/// The options that describe a closed chain, its start and the stretches of time of a measurement.
class ClosedChainOptions {
 public:
  explicit ClosedChainOptions(Options& options);

  const ClosedChain& chain() const { return chain_; }
  double relaxation_time() const { return relaxation_time_; }
  double end_time() const { return relaxation_time_ + observation_time_; }

  /// Throws UsageError where options are possible one by one but not together.
  void validate() const;

  /// A replica's chain at time 0.
  ClosedDynamics start(std::uint64_t seed, std::uint64_t replica) const;

 private:
  ClosedChain chain_;
  StartTemperatures temperatures_;
  bool zero_total_momentum_ = false;
  double relaxation_time_ = 250;
  double observation_time_ = 250;
};

/// Relative change of the invariants between two times, without sign: numerical error only, as the
/// dynamics conserves both for every sigma. Momentum relative to the larger sum |p| + sum |P|: scatterers
/// start at rest, and heavy ones gather large momenta of both signs. NaN at sigma = 1.
struct Drift {
  double energy;
  double momentum;
};

Drift drift(const Invariants& before, const Invariants& after);

}  // namespace lorentz
