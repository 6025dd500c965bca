#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "sampling/closed_parameters.hpp"

namespace lorentz {

/// Parameters of a record of a closed chain in its stationary state, from which it starts.
struct EquilibriumParameters : ClosedParameters {
  std::vector<double> times;  // over which the record is correlated

  explicit EquilibriumParameters(std::vector<double> default_times);

  double zeta() const { return fugacity.value() * ring.cell_length; }
  double scatterer_mass() const { return (1 + ring.scattering.sigma) / (1 - ring.scattering.sigma); }

  /// Number of intervals of a record, each as long as the first of `times`; lags(times) are `lags`.
  std::size_t intervals(const std::vector<std::size_t>& lags) const;
};

/// Ascending times in units of the first, the interval of a record. Throws UsageError unless they are whole
/// multiples of it.
std::vector<std::size_t> lags(const std::vector<double>& times);

/// Declares --cells, --sigma, --rule, --cell-length, --temperature, --fugacity, --observation-time and
/// --times. use: of the times, for the help.
void declare(Options& options, EquilibriumParameters& parameters, const std::string& use);

/// Throws UsageError if options that are valid one by one exclude each other.
void validate(const EquilibriumParameters& parameters);

/// Sound in the stationary state of a closed chain, for infinitely many slow particles [eqs. M11, M12, M17].
/// Validity: where momentum is conserved.
struct Sound {
  double speed;          // c, a length over a time
  double self_coupling;  // lambda_s, length^(3/2)/time

  static Sound of(const EquilibriumParameters& parameters) {
    const double z = parameters.fugacity.value(), spacing = parameters.ring.cell_length;
    const double a = z + 0.5 / spacing, rho = 2 * z + parameters.scatterer_mass() / spacing;
    const double T = parameters.temperature;
    return {2 * z * std::sqrt(T / (a * rho)), (z / a + 2 * z / rho) * std::sqrt(T / rho)};
  }

  /// Distance that a peak has covered after a time, plus its root-mean-square width [eq. M18].
  double reach(double time) const {
    const double second_moment = 0.510523;  // of f_KPZ
    return speed * time + std::sqrt(second_moment) * std::pow(self_coupling * time, 2. / 3);
  }
};

/// Throws UsageError if --cells is below `least`, with which sound does not travel around the ring.
void require_before_sound_returns(const EquilibriumParameters& parameters, double least);

}  // namespace lorentz
