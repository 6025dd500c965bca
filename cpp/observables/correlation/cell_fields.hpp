#pragma once

#include <cmath>
#include <vector>

#include "engine/observation.hpp"
#include "model/closed_chain.hpp"
#include "model/phase_point.hpp"

namespace lorentz {

/// Observer of the momentum and energy of the particles in every cell of a closed chain at gamma = N. Cell i
/// extends from scatterer i to the next one, so that particles change cells in collisions only, and a
/// snapshot costs no search for them.
class CellFields {
 public:
  /// At the beginning of a run.
  CellFields(const PhasePoint& start, const ClosedChain& chain)
      : momenta_(chain.cells, 0), energies_(chain.cells, 0) {
    for (const Particle& particle : start.particles) {
      const double scatterers_passed = std::floor(particle.position / chain.cell_length + 0.5);
      move(left_of(static_cast<std::size_t>(scatterers_passed) % chain.cells), particle.velocity, 1);
    }
  }

  void on_collision(const Collision& collision) {
    move(cell(collision.scatterer, -collision.particle_before), collision.particle_before, -1);
    move(cell(collision.scatterer, collision.particle_after), collision.particle_after, 1);
  }

  /// Sums of p and p^2/2.
  const std::vector<double>& momenta() const { return momenta_; }
  const std::vector<double>& energies() const { return energies_; }

 private:
  std::size_t left_of(std::size_t scatterer) const {
    return scatterer > 0 ? scatterer - 1 : momenta_.size() - 1;
  }
  /// On the side of a scatterer to which a direction points.
  std::size_t cell(std::size_t scatterer, double direction) const {
    return direction > 0 ? scatterer : left_of(scatterer);
  }
  void move(std::size_t cell, double velocity, double sign) {
    momenta_[cell] += sign * velocity;
    energies_[cell] += sign * 0.5 * velocity * velocity;
  }

  std::vector<double> momenta_, energies_;  // by cell
};

}  // namespace lorentz
