#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "engine/closed_dynamics.hpp"
#include "engine/closed_start.hpp"
#include "program/options.hpp"
#include "program/replicas.hpp"
#include "program/results.hpp"
#include "statistics/records.hpp"

namespace lorentz {

/// --cells, --particles-per-cell, --sigma, --gamma and --cell-length of a closed chain.
void add_chain_options(Options& options, ClosedChain& chain);

/// Throws UsageError if the chain has more particles than can be numbered, or if the numbers of a run until
/// end_time, of so many flights at most, cannot be represented. The options are those of the temperatures and
/// of the times.
void require_possible(const ClosedChain& chain, double hottest, double end_time, double most_flights,
                      const std::string& temperatures, const std::string& times);

/// The options that describe a closed chain, its start and the stretches of time of a measurement.
class ClosedChainOptions {
 public:
  /// The times are the defaults of those options; without them they are those of fig. 5.
  explicit ClosedChainOptions(double relaxation_time = 100, double observation_time = 100)
      : relaxation_time_(relaxation_time), observation_time_(observation_time) {}

  void declare(Options& options);

  /// --random-direction, for the programs that offer this control.
  void declare_random_direction(Options& options);

  const ClosedChain& chain() const { return chain_; }
  double temperature() const { return temperatures_.particles; }
  double relaxation_time() const { return relaxation_time_; }
  double observation_time() const { return observation_time_; }
  double end_time() const { return relaxation_time_ + observation_time_; }

  /// Mean square of the total momentum over replicas.
  double mean_square_momentum() const;

  /// Mean of the total energy over replicas; NaN with zero total momentum.
  double mean_energy() const;

  /// How long a clock resolves a flight at the speed of the hottest to 5e-7 of it.
  double longest_clock() const { return 0x1p32 * chain_.cell_length / std::sqrt(hottest()); }

  /// Throws UsageError where options are possible one by one but not together.
  void validate() const;

  /// A replica's chain at time 0.
  ClosedDynamics start(const StreamKey& key) const;

 private:
  double hottest() const { return std::max(temperatures_.particles, temperatures_.scatterers); }

  ClosedChain chain_;
  StartTemperatures temperatures_;
  bool zero_total_momentum_ = false;
  double relaxation_time_;
  double observation_time_;
};

/// One replica of a closed chain on its way: relaxation, stretches of observation, and the record of what
/// was seen, to which it adds the drift of the invariants.
class ClosedReplica {
 public:
  ClosedReplica(const ClosedChainOptions& options, const Replica& replica)
      : options_(options),
        replica_(replica),
        chain_(options.start(replica.key)),
        start_(chain_.invariants()),
        longest_clock_(options.longest_clock()) {}

  void relax() {
    NoObserver nobody;
    observe_until(options_.relaxation_time(), nobody);
  }

  /// The chain's clock starts again from time to time, so that it resolves every flight however long the run.
  template <class Observer>
  void observe_until(double time, Observer& observer) {
    const auto heartbeat = [this](double now) {
      replica_.heartbeat((clock_start_ + now) / options_.end_time());
    };
    while (clock(time) > longest_clock_) {
      simulate(chain_, longest_clock_, observer, heartbeat);
      chain_.restart_clock(longest_clock_);
      clock_start_ += longest_clock_;
    }
    simulate(chain_, clock(time), observer, heartbeat);
  }

  const ClosedDynamics& chain() const { return chain_; }

  /// A time as the chain's clock shows it.
  double clock(double time) const { return time - clock_start_; }

  /// Square of the conserved total momentum over its mean over replicas, minus 1: a control variate of mean 0
  /// (statistics/control_variates.hpp). 0 where there is no such momentum.
  double momentum_control() const;

  /// Total energy over its mean over replicas, minus 1: a control variate of mean 0. 0 where the mean is not
  /// known, as the start was shifted to zero total momentum.
  double energy_control() const;

  /// The sums, then the two drifts.
  ReplicaRecord record(std::vector<double> sums) const;

 private:
  const ClosedChainOptions& options_;
  const Replica& replica_;
  ClosedDynamics chain_;
  Invariants start_;
  double longest_clock_;  // of the chain, a power of two of thermal flights
  double clock_start_ = 0;
};

/// Adds the quantities energy_drift and momentum_drift, from the last two columns of the records, to what
/// `summarise` makes of the others: relative change of the invariants over a replica, without sign. It is
/// numerical error only, as the dynamics conserves both for every sigma. Momentum is measured against the
/// larger sum |p| + sum |P|: scatterers start at rest, and heavy ones gather large momenta of both signs.
std::function<Results(const Records&)> with_drift(std::function<Results(const Records&)> summarise);

}  // namespace lorentz
