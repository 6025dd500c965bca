#include "numerics/fourier_transform.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace lorentz {
namespace {

using Complex = std::complex<double>;

/// Without the treatment of infinities by operator*.
Complex product(const Complex& a, const Complex& b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

/// Factors 4 and primes, which the algorithm takes one after another.
std::vector<std::size_t> factors_of(std::size_t number) {
  std::vector<std::size_t> factors;
  for (std::size_t factor = 4; number > 1;) {
    if (number % factor == 0) {
      factors.push_back(factor);
      number /= factor;
    } else if (factor == 4) {
      factor = 2;
    } else {
      factor += factor == 2 ? 1 : 2;
      if (factor * factor > number) factor = number;
    }
  }
  return factors;
}

/// exp(-2 pi i k/n) for k < count. The angle is reduced to an eighth of the circle, where sine and cosine
/// have their smallest errors, and its symmetries hold exactly.
std::vector<Complex> roots_of_unity(std::size_t n, std::size_t count) {
  std::vector<Complex> roots;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t eighth = 8 * k / n, octant = (eighth + 1) / 2 * 2;  // the nearest multiple of a quarter
    const double turns =
        (static_cast<double>(8 * k) - static_cast<double>(octant * n)) / static_cast<double>(n);
    const double angle = turns * (std::numbers::pi / 4);
    const double c = std::cos(angle), s = std::sin(angle);
    switch (octant / 2 % 4) {
      case 0:
        roots.emplace_back(c, -s);
        break;
      case 1:
        roots.emplace_back(-s, -c);
        break;
      case 2:
        roots.emplace_back(-c, s);
        break;
      default:
        roots.emplace_back(s, c);
    }
  }
  return roots;
}

}  // namespace

FourierTransform::FourierTransform(std::size_t length)
    : factors_(factors_of(length)), roots_(roots_of_unity(length, length)) {}

std::vector<Complex> FourierTransform::operator()(const std::vector<Complex>& f) const {
  if (f.size() != roots_.size()) throw std::invalid_argument("a field of another length");
  std::vector<Complex> result(f.size());
  std::vector<Complex> terms(factors_.empty() ? 0 : *std::ranges::max_element(factors_));
  transform(f.data(), 1, result.data(), f.size(), factors_.data(), terms.data());
  return result;
}

/// Transforms of the `factor` interleaved parts of f, then their combination.
void FourierTransform::transform(const Complex* f, std::size_t stride, Complex* result, std::size_t length,
                                 const std::size_t* factor, Complex* terms) const {
  if (length == 1) {
    *result = *f;
    return;
  }
  const std::size_t parts = *factor, size = length / parts;
  for (std::size_t part = 0; part < parts; ++part)
    transform(f + part * stride, stride * parts, result + part * size, size, factor + 1, terms);
  if (parts == 4) {
    for (std::size_t k = 0; k < size; ++k) {
      Complex* const at = result + k;
      const Complex a = at[0], b = product(at[size], roots_[k * stride]),
                    c = product(at[2 * size], roots_[2 * k * stride]),
                    d = product(at[3 * size], roots_[3 * k * stride]);
      const Complex even = a + c, odd = a - c, sum = b + d, difference = b - d;
      const Complex turned(difference.imag(), -difference.real());  // -i (b - d)
      at[0] = even + sum;
      at[size] = odd + turned;
      at[2 * size] = even - sum;
      at[3 * size] = odd - turned;
    }
    return;
  }
  for (std::size_t k = 0; k < size; ++k) {
    for (std::size_t part = 0; part < parts; ++part)
      terms[part] = product(result[k + part * size], roots_[part * k * stride]);
    for (std::size_t q = 0; q < parts; ++q) {
      Complex sum = terms[0];
      for (std::size_t part = 1; part < parts; ++part)
        sum += product(terms[part], roots_[part * q % parts * size * stride]);
      result[k + q * size] = sum;
    }
  }
}

RealFourierTransform::RealFourierTransform(std::size_t length)
    : length_(length),
      transform_(length % 2 == 0 ? length / 2 : length),
      roots_(roots_of_unity(length, length % 2 == 0 ? length / 2 + 1 : 0)) {}

std::vector<Complex> RealFourierTransform::operator()(const std::vector<double>& f) const {
  if (f.size() != length_) throw std::invalid_argument("a field of another length");
  if (length_ % 2 == 1) {
    std::vector<Complex> result = transform_({f.begin(), f.end()});
    result.resize(length_ / 2 + 1);
    return result;
  }
  // One complex field of half the length: even sites are its real part, odd sites its imaginary part.
  const std::size_t half = length_ / 2;
  std::vector<Complex> pairs;
  for (std::size_t i = 0; i < half; ++i) pairs.emplace_back(f[2 * i], f[2 * i + 1]);
  const std::vector<Complex> both = transform_(pairs);
  std::vector<Complex> result;
  for (std::size_t k = 0; k <= half; ++k) {
    const Complex one = both[k % half], other = std::conj(both[(half - k) % half]);
    const Complex even = 0.5 * (one + other), odd = 0.5 * (one - other);  // odd: times i
    result.push_back(even + product(Complex(odd.imag(), -odd.real()), roots_[k]));
  }
  return result;
}

}  // namespace lorentz
