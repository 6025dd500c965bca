#pragma once

#include <gsl/gsl_fft_halfcomplex.h>
#include <gsl/gsl_fft_real.h>

#include <cstddef>
#include <deque>
#include <memory>
#include <span>
#include <vector>

namespace lorentz {

/// Correlations in space and time of a field on a ring, from snapshots at equal intervals [eq. 54]:
///
///   C(r, m) = mean over cells i and snapshots j of a_i(j) a_{i+r}(j+m),
///
/// symmetrised in r. Sums over cells are products of Fourier transforms, whose length is best a product of
/// small primes: a prime factor p costs p times as much as one of 2.
class RingCorrelation {
 public:
  /// lags: the m, ascending.
  RingCorrelation(std::size_t cells, std::vector<std::size_t> lags);

  /// Adds the next snapshot.
  void add(std::vector<double> field);

  /// C(r, lags[k]), r = 0 ... cells - 1. Throws std::logic_error if fewer than
  /// lags[k] + 1 snapshots were added.
  std::vector<double> at(std::size_t k) const;

 private:
  struct Free {
    void operator()(gsl_fft_real_wavetable* table) const { gsl_fft_real_wavetable_free(table); }
    void operator()(gsl_fft_halfcomplex_wavetable* table) const { gsl_fft_halfcomplex_wavetable_free(table); }
    void operator()(gsl_fft_real_workspace* space) const { gsl_fft_real_workspace_free(space); }
  };
  /// Sum of the products of two transforms at every wave number, and their number.
  struct Spectrum {
    std::vector<double> sum;
    double count = 0;
  };

  std::size_t cells_;
  std::vector<std::size_t> lags_;
  std::vector<Spectrum> spectra_;               // by lag
  std::deque<std::vector<double>> transforms_;  // of the last snapshots, latest first, half-complex
  std::unique_ptr<gsl_fft_real_wavetable, Free> forward_;
  std::unique_ptr<gsl_fft_halfcomplex_wavetable, Free> backward_;
  std::unique_ptr<gsl_fft_real_workspace, Free> workspace_;
};

}  // namespace lorentz
