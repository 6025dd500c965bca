#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "engine/closed_dynamics.hpp"
#include "program/study.hpp"
#include "sampling/closed_parameters.hpp"
#include "statistics/group.hpp"
#include "statistics/tally.hpp"

namespace lorentz {

/// Conservation errors of a closed chain, recorded by every observable of it: absolute relative changes of
/// the invariants over a replica [eq. 3]. They are purely numerical; what the collision rule does not
/// conserve is NaN. The scale of the momentum's error is the larger one of sum |p| + sum |P| at the start and
/// at the end, because scatterers may start at rest and heavy ones acquire large momenta of both signs.
struct ClosedTallies : TallySchema {
  ScalarTally energy_change =
      tally("energy_change", "1", "Mean over replicas of |change of total energy| / total energy");
  ScalarTally momentum_change = tally(
      "momentum_change", "1", "Mean over replicas of |change of total momentum| / sum of all |momenta|");
};

/// Simulation of one replica of a closed chain: relaxation, observation, conservation check.
class ClosedRun {
 public:
  ClosedRun(const ClosedParameters& parameters, const Replica& replica);

  /// Advances to the end of the relaxation without an observer.
  void relax() {
    NoObserver nobody;
    observe(nobody, parameters_.relaxation_time);
  }

  /// Advances to the end of the observation with an observer of collisions and flights
  /// (engine/observation.hpp).
  template <class Observer>
  void observe(Observer& observer) {
    observe(observer, parameters_.end_time());
  }

  /// Advances to a time. The clock of the dynamics restarts at intervals, so that its resolution does not
  /// decrease in long runs.
  template <class Observer>
  void observe(Observer& observer, double time) {
    static_assert(
        std::same_as<Observer, NoObserver> ||
            requires(const Collision& collision) { observer.on_collision(collision); } ||
            requires(const Departure& departure) { observer.on_flight(departure); },
        "the observer has no hook: on_collision(const Collision&) or on_flight(const Departure&)");
    const Heartbeat heartbeat = [this](double now) {
      replica_.heartbeat((clock_start_ + now) / parameters_.end_time());
    };
    while (clock(time) > longest_clock_) {
      simulate(chain_, longest_clock_, observer, heartbeat);
      chain_.restart_clock(longest_clock_);
      clock_start_ += longest_clock_;
    }
    simulate(chain_, clock(time), observer, heartbeat);
  }

  const ClosedDynamics& chain() const { return chain_; }

  /// Time on the clock of the dynamics.
  double clock(double time) const { return time - clock_start_; }

  /// Control variate of mean 0: square of the conserved total momentum over its mean over replicas, minus 1
  /// [eq. 32]. It is 0 if the momentum is zero or not conserved.
  double momentum_control() const;

  /// Records the conservation errors so far; returns the number of events.
  std::uint64_t finish(const ClosedTallies& tallies, TallySums& sums) const;

 private:
  const ClosedParameters& parameters_;
  const Replica& replica_;
  ClosedDynamics chain_;
  Invariants start_;
  double longest_clock_;  // 2^32 flights at the speed of the hottest particles
  double clock_start_ = 0;
};

/// State at the end of the relaxation, and the number of events until then. Without relaxation the state is
/// that of the start, digit by digit.
std::pair<PhasePoint, std::uint64_t> relaxed_start(const ClosedParameters& parameters,
                                                   const Replica& replica);

/// Study of a closed chain: every replica relaxes, `observe` takes the run through its observation and fills
/// the tallies, and the conservation errors are added. The parameters are valid.
Study closed_study(const ClosedParameters& parameters, const ClosedTallies& tallies,
                   const std::function<void(ClosedRun&, TallySums&)>& observe, std::vector<Group> groups,
                   const std::string& target);

}  // namespace lorentz
