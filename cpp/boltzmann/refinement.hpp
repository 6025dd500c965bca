#pragma once

#include <memory>

#include "boltzmann/solver.hpp"

namespace lorentz {

/// Solution and the coarser one from which its error is estimated.
struct RefinedSolution {
  std::unique_ptr<KineticSolution> coarse, fine;
  double error;  // largest difference of the currents, see refine()
  int evaluations;
};

/// Raises the resolution level by level until the currents of particles, energy and momentum of two
/// successive solutions differ by less than the target. Differences are relative to the current, or to the
/// injected current divided by 1 + gamma if that is larger, because currents may vanish. Refinement also ends
/// where it no longer reduces the difference, because of rounding, and at the finest level. It begins at
/// level 0 of Resolution, or `coarsening` levels below to show the convergence. Throws ConvergenceError.
RefinedSolution refine(const KineticProblem& problem, double target, int coarsening = 0);

}  // namespace lorentz
