#pragma once

#include <vector>

#include "engine/closed_dynamics.hpp"

namespace support {

struct Recorder {
  std::vector<lorentz::Collision> collisions;
  void on_collision(const lorentz::Collision& collision) { collisions.push_back(collision); }
};

inline void nothing(double) {}

/// All collisions of a chain until `until`.
inline std::vector<lorentz::Collision> collisions(const lorentz::ClosedChain& chain,
                                                  const lorentz::PhasePoint& start, double until) {
  lorentz::ClosedDynamics dynamics(chain, start, until, {1, 0});
  Recorder recorder;
  lorentz::simulate(dynamics, until, recorder, nothing);
  return recorder.collisions;
}

}  // namespace support
