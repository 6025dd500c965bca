#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "model/phase_point.hpp"
#include "observables/correlation/ring_correlation.hpp"
#include "sampling/closed_parameters.hpp"
#include "sampling/conserved_fields.hpp"

namespace lorentz {

/// Correlations of the conserved fields of a closed chain, from snapshots at equal intervals [eq. 54].
class FieldCorrelations {
 public:
  /// lags: in units of the interval.
  FieldCorrelations(const ClosedParameters& parameters, const std::vector<std::size_t>& lags);

  void add(const PhasePoint& point);

  /// Covariance at the lag number k of a field with its value in the middle of the ring, by cell.
  std::vector<double> profile(std::size_t field, std::size_t k) const;

 private:
  ClosedChain chain_;
  std::array<double, 3> variances_;
  std::vector<RingCorrelation> correlations_;  // by Conserved
};

/// Variances over replicas of the totals of a ring, by Conserved [eq. 55]. That of the number is 0, because
/// every cell starts with as many particles.
std::array<double, 3> total_variances(const ClosedParameters& parameters);

}  // namespace lorentz
