#include "numerics/fourier_transform.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

namespace fourier_transform_test {

using namespace lorentz;
using Complex = std::complex<double>;

/// The Fourier transform by its definition, in extended precision.
Complex direct(const std::vector<Complex>& f, std::size_t k) {
  std::complex<long double> sum = 0;
  for (std::size_t j = 0; j < f.size(); ++j) {
    const auto turns = static_cast<long double>(j * k % f.size()) / static_cast<long double>(f.size());
    sum += std::complex<long double>(f[j]) * std::polar(1.0L, -2 * std::numbers::pi_v<long double> * turns);
  }
  return Complex(sum);
}

std::vector<Complex> noise(std::size_t length, bool real) {
  std::mt19937_64 generator(length);
  std::normal_distribution<double> normal;
  std::vector<Complex> f;
  for (std::size_t j = 0; j < length; ++j) f.emplace_back(normal(generator), real ? 0 : normal(generator));
  return f;
}

/// Test lengths: every small one, products of all small primes, a square and a large prime.
std::vector<std::size_t> lengths() {
  std::vector<std::size_t> all;
  for (std::size_t length = 1; length <= 36; ++length) all.push_back(length);
  all.insert(all.end(), {49, 97, 101, 120, 169, 210, 216, 343, 512, 1001, 2160});
  return all;
}

TEST(FourierTransform, IsItsDefinition) {
  for (const std::size_t length : lengths()) {
    const std::vector<Complex> f = noise(length, false), found = FourierTransform(length)(f);
    ASSERT_EQ(found.size(), length);
    for (std::size_t k = 0; k < length; ++k)
      EXPECT_NEAR(std::abs(found[k] - direct(f, k)), 0, 2e-15 * std::sqrt(length)) << length << ' ' << k;
  }
}

TEST(RealFourierTransform, IsItsDefinition) {
  for (const std::size_t length : lengths()) {
    const std::vector<Complex> f = noise(length, true);
    std::vector<double> real;
    for (const Complex& value : f) real.push_back(value.real());
    const std::vector<Complex> found = RealFourierTransform(length)(real);
    ASSERT_EQ(found.size(), length / 2 + 1);
    for (std::size_t k = 0; k < found.size(); ++k)
      EXPECT_NEAR(std::abs(found[k] - direct(f, k)), 0, 2e-15 * std::sqrt(length)) << length << ' ' << k;
  }
}

TEST(FourierTransform, NeedsAFieldOfItsLength) {
  EXPECT_THROW(FourierTransform(3)(noise(4, false)), std::invalid_argument);
  EXPECT_THROW(RealFourierTransform(4)({1, 2, 3}), std::invalid_argument);
}

}  // namespace fourier_transform_test
