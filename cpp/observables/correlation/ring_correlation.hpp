#pragma once

#include <gsl/gsl_fft_real.h>

#include <cstddef>
#include <deque>
#include <vector>

#include "numerics/gsl.hpp"

namespace lorentz {

/// Correlations in space and time of a field on a ring, from snapshots at equal intervals [eq. 54]:
///
///   C(r, m) = mean over cells i and snapshots j of a_i(j) a_{i+r}(j+m),
///
/// symmetrised in r. Sums over cells are products of Fourier transforms. A prime factor p of the number of
/// cells costs as much as p/2 factors of 2.
class RingCorrelation {
 public:
  /// lags: the m, ascending.
  RingCorrelation(std::size_t cells, std::vector<std::size_t> lags);

  /// Adds the next snapshot.
  void add(const std::vector<double>& field);

  /// C(r, lags[k]), r = 0 ... cells - 1. At least lags[k] + 1 snapshots were added.
  std::vector<double> at(std::size_t k) const;

 private:
  /// Sum of the products of two transforms, element by element, and their number.
  struct Spectrum {
    std::vector<double> sum;
    double count = 0;
  };
  using Table = GslObject<gsl_fft_real_wavetable, gsl_fft_real_wavetable_alloc, gsl_fft_real_wavetable_free>;
  using Workspace =
      GslObject<gsl_fft_real_workspace, gsl_fft_real_workspace_alloc, gsl_fft_real_workspace_free>;

  /// Fourier transform of a field, in GSL's order: F(0), Re F(1), Im F(1), Re F(2), ...
  std::vector<double> transform(std::vector<double> field) const;

  std::size_t cells_;
  std::vector<std::size_t> lags_;
  std::vector<Spectrum> spectra_;               // by lag
  std::deque<std::vector<double>> transforms_;  // of the last snapshots, latest first
  Table table_;
  Workspace workspace_;
};

}  // namespace lorentz
