#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "engine/open_dynamics.hpp"
#include "engine/relaxation.hpp"
#include "program/study.hpp"
#include "sampling/open_parameters.hpp"

namespace lorentz {

/// Simulation of one replica of an open chain: relaxation and a window of observation.
class OpenRun {
 public:
  OpenRun(const OpenParameters& parameters, const Window& window, const Replica& replica)
      : window_(window),
        replica_(replica),
        chain_(parameters.chain(), parameters.start_point(window.end, replica.key), window.end, replica.key) {
  }

  /// Advances to the window without an observer, then through it with an observer of collisions, flights,
  /// injections and exits (engine/observation.hpp). If the observer has finish(scatterers, end), it is
  /// called at the end with U of every scatterer.
  template <class Observer>
  void observe(Observer& observer) {
    static_assert(
        std::same_as<Observer, NoObserver> ||
            requires(const Collision& collision) { observer.on_collision(collision); } ||
            requires(const Path& path) { observer.on_flight(path); },
        "the observer has no hook: on_collision(const Collision&) or on_flight(const Path&)");
    const Heartbeat heartbeat = [this](double now) { replica_.heartbeat(now / window_.end); };
    lorentz::relax(chain_, window_.begin, observer, heartbeat);
    simulate(chain_, window_.end, observer, heartbeat);
    if constexpr (requires { observer.finish(chain_.scatterers(), window_.end); })
      observer.finish(chain_.scatterers(), window_.end);
  }

  std::uint64_t events() const { return chain_.events(); }

 private:
  Window window_;
  const Replica& replica_;
  OpenDynamics chain_;
};

/// Study of an open chain: make_observer() gives the observer of a replica, which runs through the window and
/// fills the tallies, observer.record(tallies, sums). The parameters are valid.
template <class Tallies, std::invocable MakeObserver>
Study open_study(const OpenParameters& parameters, const Window& window, const Tallies& tallies,
                 const MakeObserver& make_observer, std::vector<Group> groups, const std::string& target) {
  const auto sample = [=](const Replica& replica, TallySums& sums) {
    OpenRun run(parameters, window, replica);
    auto observer = make_observer();
    run.observe(observer);
    observer.record(tallies, sums);
    return run.events();
  };
  return {.tallies = tallies, .sample = sample, .groups = std::move(groups), .target = target};
}

}  // namespace lorentz
