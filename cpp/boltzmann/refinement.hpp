#pragma once

#include <memory>

#include "boltzmann/solver.hpp"

namespace lorentz {

/// A solution and the coarser one that its error is judged by.
struct RefinedSolution {
  std::unique_ptr<KineticSolution> coarse, fine;
  double error;  // of the currents, see refine()
  int evaluations;
};

/// Doubles the resolution until the currents of particles, energy and momentum of two successive solutions
/// differ by less than the target, relative to themselves; or, for currents that nothing drives, to what the
/// baths inject divided by 1 + gamma. Stops as well where a finer resolution does not help: rounding, or the
/// finest there is. Begins at the level 0 of Resolution, or `coarsening` levels below it, to show how the
/// error falls. Throws ConvergenceError.
RefinedSolution refine(
    const KineticProblem& problem, double target, int coarsening = 0, const Heartbeat& heartbeat = [] {});

}  // namespace lorentz
