#pragma once

#include <complex>
#include <cstddef>
#include <vector>

namespace lorentz {

/// Discrete Fourier transform F(k) = sum_j f(j) exp(-2 pi i j k/n) of any length n, by Cooley & Tukey's
/// algorithm for the prime factors of n (Math. Comput. 19, 297 (1965)). A prime factor p costs p times as
/// much as one of 2. The roots of unity are computed from numerics/elementary.hpp; those of GSL's and of
/// Eigen's transforms come from the C library, whose last digits depend on the processor.
class FourierTransform {
 public:
  using Complex = std::complex<double>;

  /// Length n > 0.
  explicit FourierTransform(std::size_t length);

  std::vector<Complex> operator()(const std::vector<Complex>& f) const;

 private:
  void transform(const Complex* f, std::size_t stride, Complex* result, std::size_t length,
                 const std::size_t* factor, Complex* terms) const;

  std::vector<std::size_t> factors_;
  std::vector<Complex> roots_;  // exp(-2 pi i k/n)
};

/// Transform of a real field: F(k) for k = 0, ..., n/2; the others are their complex conjugates. For even n
/// it is half as long as the transform of a complex field.
class RealFourierTransform {
 public:
  explicit RealFourierTransform(std::size_t length);

  std::vector<std::complex<double>> operator()(const std::vector<double>& f) const;

 private:
  std::size_t length_;
  FourierTransform transform_;
  std::vector<std::complex<double>> roots_;  // exp(-2 pi i k/n), for even n
};

}  // namespace lorentz
