#pragma once

#include <gtest/gtest.h>

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

/// Expects both lists of collisions to be equal in all numbers.
inline void expect_same(const std::vector<lorentz::Collision>& a, const std::vector<lorentz::Collision>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    ASSERT_EQ(a[k].time, b[k].time) << k;
    ASSERT_EQ(a[k].particle, b[k].particle) << k;
    ASSERT_EQ(a[k].scatterer, b[k].scatterer) << k;
    ASSERT_EQ(a[k].particle_before, b[k].particle_before) << k;
    ASSERT_EQ(a[k].particle_after, b[k].particle_after) << k;
    ASSERT_EQ(a[k].scatterer_before, b[k].scatterer_before) << k;
    ASSERT_EQ(a[k].scatterer_after, b[k].scatterer_after) << k;
  }
}

}  // namespace support
