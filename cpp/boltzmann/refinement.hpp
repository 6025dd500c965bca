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
/// differ by less than the target, relative to what the baths inject, divided by 1 + gamma: the order of
/// magnitude of a current that is driven. Stops at the finest resolution there is. Throws ConvergenceError.
RefinedSolution refine(const KineticProblem& problem, double target);

}  // namespace lorentz
