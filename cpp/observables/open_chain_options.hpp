#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/open_dynamics.hpp"
#include "engine/relaxation.hpp"
#include "model/open_chain.hpp"
#include "program/options.hpp"
#include "program/replicas.hpp"

namespace lorentz {

/// The options that describe an open chain, its reservoirs, its start and the stretches of time of a
/// measurement.
class OpenChainOptions {
 public:
  struct Times {
    Scaled relaxation, observation;
  };

  /// The defaults of those options; a cell length of 0 stands for 1/N. With times there are --relaxation-time
  /// and --observation-time, for what is measured in a window.
  OpenChainOptions(const OpenChain& chain, const std::string& start, std::optional<Times> times = {})
      : chain_(chain), start_(start), times_(times) {}

  void declare(Options& options);

  /// With the default of the cell length put in.
  OpenChain chain() const;
  Window window() const;

  /// Throws UsageError where options are possible one by one but not together, for a run until `end`, which
  /// the options `times` give.
  void validate(double end, const std::string& times) const;
  void validate() const;

  /// A replica from its start, watched by the observer in a window, and its record(). At the end the
  /// observer's finish(scatterers, end) is called before, with U of every scatterer, if it has one.
  template <class Observer>
  ReplicaRecord measure(const Replica& replica, const Window& window, Observer observer) const {
    OpenDynamics dynamics(chain(), start(window.end, replica.key), window.end, replica.key);
    const auto heartbeat = [&](double now) { replica.heartbeat(now / window.end); };
    relax(dynamics, window.begin, observer, heartbeat);
    simulate(dynamics, window.end, observer, heartbeat);
    if constexpr (requires { observer.finish(dynamics.scatterers(), window.end); })
      observer.finish(dynamics.scatterers(), window.end);
    return {observer.record(), dynamics.events()};
  }

 private:
  PhasePoint start(double age, const StreamKey& key) const;

  OpenChain chain_;
  std::string start_;
  std::optional<Times> times_;
};

/// What the reservoirs inject in a window, minus its known mean: the control variates of every stationary
/// measurement. Numbers, momenta and energies, first of the left reservoir, then of the right one.
class InjectionControls {
 public:
  static constexpr std::size_t count = 6;

  void add(End end, double u) {
    double* const sums = sums_ + 3 * static_cast<std::size_t>(end);
    sums[0] += 1;
    sums[1] += std::abs(u);
    sums[2] += 0.5 * u * u;
  }

  /// Appends the deviations after `duration` to a record.
  void append_to(std::vector<double>& record, const OpenChain& chain, double duration) const;

 private:
  double sums_[count] = {};
};

}  // namespace lorentz
