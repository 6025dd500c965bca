#pragma once

#include <Eigen/Core>

#include "boltzmann/solver.hpp"

namespace lorentz {

/// Positions and momenta at which a kinetic solution is evaluated.
struct FieldGrid {
  Eigen::VectorXd crossings;   // x of the flux
  Eigen::VectorXd scatterers;  // x of the scatterers
  Eigen::VectorXd edges;       // of equal bins of p >= 0, from 0 on
  Eigen::VectorXd middles;     // of these bins
  double bin_width;
  double root_mass;  // sqrt(M) = P/U
};

/// Physical quantities of a solution on a grid. Matrices have one column per position and one row per bin of
/// p, in ascending order over both half lines; vectors have one element per position.
struct KineticFields {
  KineticFields(const KineticProblem& problem, const KineticSolution& solution, const FieldGrid& grid);

  Eigen::MatrixXd flux;               // F, mean over a bin
  Eigen::MatrixXd flux_density;       // F at the middle of a bin
  Eigen::MatrixXd scatterer_density;  // g(P)
  double particle_current, energy_current;
  double current_spread;  // largest deviation of a current over x, relative to the injected one [eq. 40]
  Eigen::RowVectorXd scatterer_temperature, particle_temperature;  // [eq. 39]
  double conductivity;  // of a chain [eq. 28]; NaN without a difference of temperature
  Eigen::RowVectorXd rate_right, rate_left;
  Eigen::RowVectorXd jump;   // of F at p = 0
  Eigen::MatrixXd kurtosis;  // row 0: p < 0, row 1: p > 0; NaN on overflow
};

}  // namespace lorentz
