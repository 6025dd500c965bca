#include "engine/open_dynamics.hpp"

#include <stdexcept>

namespace lorentz {
namespace {

/// Throws std::invalid_argument unless there is one scatterer per cell.
const PhasePoint& checked(const PhasePoint& start, const OpenChain& chain) {
  if (start.scatterers.size() != chain.cells)
    throw std::invalid_argument("the start does not have one scatterer per cell");
  return start;  // NOLINT(bugprone-return-const-ref-from-parameter): read at once
}

}  // namespace

OpenDynamics::OpenDynamics(const OpenChain& chain, const PhasePoint& start, double end_time,
                           const StreamKey& key)
    : chain_(chain),
      collide_(chain.sigma),
      cells_to_scattering_(chain.gamma / chain.cells),
      half_cell_(chain.cell_length / 2),
      passes_(key, Purpose::passes, 0),
      injectors_{Injector(chain.left, key, Purpose::injection_left),
                 Injector(chain.right, key, Purpose::injection_right)},
      scatterers_(collide_.scaled(checked(start, chain).scatterers)),
      newcomers_(start.particles),
      queue_({}, chain.left.rate + chain.right.rate, end_time) {}

std::vector<double> OpenDynamics::scatterers() const { return collide_.unscaled(scatterers_); }

double OpenDynamics::energy() const {
  double twice_energy = 0;
  for (const double U : scatterers()) twice_energy += U * U;
  for (const Flight& flight : queue_.flights()) twice_energy += flight.velocity * flight.velocity;
  return 0.5 * twice_energy;
}

}  // namespace lorentz
