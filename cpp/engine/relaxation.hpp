#pragma once

#include <vector>

#include "engine/open_dynamics.hpp"

namespace lorentz {

/// Flights that end at a time or later.
struct UnfinishedFlights {
  double time;
  std::vector<Path> paths{};
  void on_flight(const Path& path) {
    if (!(path.arrival < time)) [[unlikely]]
      paths.push_back(path);
  }
};

/// Compiled once.
extern template void simulate(OpenDynamics&, double, UnfinishedFlights&, const Heartbeat&);

/// Advances the chain through every event before `until` without the observer, which costs less. Then
/// notifies the observer of the pending flights and exits, as it would have been at their departure.
template <class Observer>
void relax(OpenDynamics& chain, double until, Observer& observer, const Heartbeat& heartbeat) {
  UnfinishedFlights flights{until};
  simulate(chain, until, flights, heartbeat);
  for (const Path& path : flights.paths) {
    if constexpr (requires { observer.on_flight(path); }) observer.on_flight(path);
    if constexpr (requires { observer.on_exit(End::left, path.arrival, path.velocity); }) {
      const bool leaves = path.last % 2 == 0;  // scatterers are at odd positions
      if (leaves) observer.on_exit(path.last > 0 ? End::right : End::left, path.arrival, path.velocity);
    }
  }
}

}  // namespace lorentz
