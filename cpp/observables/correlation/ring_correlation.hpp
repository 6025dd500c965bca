#pragma once

#include <complex>
#include <cstddef>
#include <deque>
#include <vector>

#include "numerics/fourier_transform.hpp"

namespace lorentz {

/// Correlations in space and time of a field on a ring, from snapshots at equal intervals [eq. 54]:
///
///   C(r, m) = mean over cells i and snapshots j of a_i(j) a_{i+r}(j+m),
///
/// symmetrised in r. Sums over cells are products of Fourier transforms, whose length is best a product of
/// small primes (numerics/fourier_transform.hpp).
class RingCorrelation {
 public:
  /// lags: the m, ascending.
  RingCorrelation(std::size_t cells, std::vector<std::size_t> lags);

  /// Adds the next snapshot.
  void add(const std::vector<double>& field);

  /// C(r, lags[k]), r = 0 ... cells - 1. Throws std::logic_error if fewer than
  /// lags[k] + 1 snapshots were added.
  std::vector<double> at(std::size_t k) const;

 private:
  /// Sum of the products of two transforms at the wave numbers 0 ... cells/2, and their number.
  struct Spectrum {
    std::vector<double> sum;
    double count = 0;
  };

  std::size_t cells_;
  std::vector<std::size_t> lags_;
  std::vector<Spectrum> spectra_;                             // by lag
  std::deque<std::vector<std::complex<double>>> transforms_;  // of the last snapshots, latest first
  RealFourierTransform transform_;
};

}  // namespace lorentz
