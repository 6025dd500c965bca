#pragma once

#include <vector>

#include "engine/observation.hpp"
#include "sampling/closed_run.hpp"
#include "statistics/time_integral.hpp"

namespace lorentz {

/// Observer of the total currents of heat and of particles in a closed chain,
///
///   J_q = sum of u (u^2/2 - T),  J_n = sum of u,  over all particles [eq. M21],
///
/// which are constant between two collisions: their integrals over blocks of time are exact.
class Currents {
 public:
  /// The run must be at the beginning of the first block.
  Currents(const ClosedRun& run, double temperature, const Blocks& blocks)
      : run_(run),
        temperature_(temperature),
        end_(blocks.edge(blocks.count())),
        heat_(blocks),
        number_(blocks) {
    for (const Particle& particle : run.chain().phase_point(run.clock(blocks.edge(0))).particles) {
      heat_current_ += heat(particle.velocity);
      number_current_ += particle.velocity;
    }
  }

  void on_collision(const Collision& collision) {
    advance(collision.time - run_.clock(0));
    heat_current_ += heat(collision.particle_after) - heat(collision.particle_before);
    number_current_ += collision.particle_after - collision.particle_before;
  }

  /// Completes the last block.
  void finish() { advance(end_); }

  /// Integrals over the blocks.
  const std::vector<double>& heat() const { return heat_.sums(); }
  const std::vector<double>& number() const { return number_.sums(); }

 private:
  double heat(double u) const { return u * (0.5 * u * u - temperature_); }
  void advance(double time) {
    heat_.advance(heat_current_, time);
    number_.advance(number_current_, time);
  }

  const ClosedRun& run_;
  double temperature_, end_;
  double heat_current_ = 0, number_current_ = 0;
  TimeIntegral heat_, number_;
};

}  // namespace lorentz
