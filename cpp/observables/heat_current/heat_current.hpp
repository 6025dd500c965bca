// For the study "does the paper hold?" only (panel `momentum`); no figure of the paper needs it.
#pragma once

#include <vector>

#include "engine/observation.hpp"
#include "sampling/closed_run.hpp"
#include "statistics/time_integral.hpp"

namespace lorentz {

/// Observer of the total heat current of a closed chain, J_q = sum of u (u^2/2 - T) over all particles
/// [eq. 54], which is constant between two collisions: its integrals over blocks of time are exact. A rule
/// that changes a neighbouring scatterer carries energy over one cell at once.
class HeatCurrent {
 public:
  /// The run must be at the beginning of the first block.
  HeatCurrent(const ClosedRun& run, const ClosedChainParameters& ring, double temperature,
              const Blocks& blocks)
      : run_(run),
        cell_length_(ring.cell_length),
        temperature_(temperature),
        end_(blocks.edge(blocks.count())),
        heat_(blocks) {
    for (const Particle& particle : run.chain().phase_point(run.clock(blocks.edge(0))).particles)
      current_ += heat(particle.velocity);
  }

  void on_collision(const Collision& collision) {
    heat_.advance(current_, collision.time - run_.clock(0));
    current_ += heat(collision.particle_after) - heat(collision.particle_before);
    if (collision.neighbour != 0) heat_.add(collision.neighbour * cell_length_ * to_neighbour(collision));
  }

  /// Completes the last block.
  void finish() { heat_.advance(current_, end_); }

  /// Integrals over the blocks.
  const std::vector<double>& integrals() const { return heat_.sums(); }

 private:
  double heat(double u) const { return u * (0.5 * u * u - temperature_); }

  /// Energy that particle and scatterer lose.
  static double to_neighbour(const Collision& c) {
    const auto gain = [](double before, double after) { return 0.5 * (after - before) * (after + before); };
    return -gain(c.particle_before, c.particle_after) - gain(c.scatterer_before, c.scatterer_after);
  }

  const ClosedRun& run_;
  double cell_length_, temperature_, end_;
  double current_ = 0;
  TimeIntegral heat_;
};

}  // namespace lorentz
