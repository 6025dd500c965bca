#include "engine/open_dynamics.hpp"

#include <stdexcept>

#include "engine/relaxation.hpp"

namespace lorentz {
namespace {

/// Throws std::invalid_argument unless there is one scatterer per cell.
const PhasePoint& checked(const PhasePoint& start, const OpenChain& chain) {
  if (start.scatterers.size() != chain.cells)
    throw std::invalid_argument("the start does not have one scatterer per cell");
  return start;  // NOLINT(bugprone-return-const-ref-from-parameter): read at once
}

}  // namespace

template void simulate(OpenDynamics&, double, UnfinishedFlights&, const Heartbeat&);

OpenDynamics::OpenDynamics(const OpenChain& chain, const PhasePoint& start, double end_time,
                           const StreamKey& key)
    : chain_(chain),
      rule_(make_rule(chain.rule, chain.sigma)),
      cells_to_scattering_(chain.scattering_probability()),
      half_cell_(chain.cell_length / 2),
      key_(key),
      passes_(key, Purpose::passes, 0),
      injectors_{Injector(chain.left, key, Purpose::injection_left),
                 Injector(chain.right, key, Purpose::injection_right)},
      scatterers_(masses(rule_).scaled(checked(start, chain).scatterers)),
      drawn_(chain.cells, 0),
      newcomers_(start.particles),
      queue_({}, chain.left.rate + chain.right.rate, end_time) {}

std::vector<double> OpenDynamics::scatterers() const { return masses(rule_).unscaled(scatterers_); }

}  // namespace lorentz
