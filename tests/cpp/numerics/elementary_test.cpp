#include "numerics/elementary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace elementary_test {

/// Largest error in units in the last place relative to long double, at logarithmically spaced arguments from
/// low to high.
template <class Function, class Exact>
double worst(Function function, Exact exact, double low, double high) {
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> exponent(std::log(low), std::log(high));
  double worst = 0;
  for (int i = 0; i < 100'000; ++i) {
    const double x = std::min(high, std::exp(exponent(generator)));
    const long double value = exact(static_cast<long double>(x));
    const auto rounded = static_cast<double>(std::abs(value));
    const double unit = std::nextafter(rounded, std::numeric_limits<double>::infinity()) - rounded;
    worst = std::max(worst, static_cast<double>(std::abs(function(x) - value) / unit));
  }
  return worst;
}

#define EXPECT_ULP(bound, name, sign, low, high)                               \
  EXPECT_LE(worst([](double x) { return elementary::name(sign x); },           \
                  [](long double x) { return std::name(sign x); }, low, high), \
            bound)                                                             \
      << #name

constexpr double tiny = 5e-324, huge = 1e308;

TEST(Portable, FunctionsAreWithinTheirErrors) {
  EXPECT_ULP(3.5, log, , tiny, huge);
  EXPECT_ULP(3.5, log, , 0.5, 2);
  EXPECT_ULP(1, log1p, -, 1e-300, 0.999);
  EXPECT_ULP(1, exp, -, 1e-300, 700);
  EXPECT_ULP(1, expm1, -, 1e-300, 700);
  EXPECT_ULP(3.5, cos, , 1e-300, 100);
  EXPECT_ULP(3.5, sin, , 1e-300, 100);
  EXPECT_ULP(1, erf, , 1e-300, 10);
  EXPECT_ULP(1.5, erfc, , 1e-300, 5);
  EXPECT_ULP(4, log10, , tiny, 0.9);
}

TEST(Portable, PowersAreWithinTheirError) {
  for (const double exponent : {-3., 0.3, 2., 17.})
    EXPECT_LE(
        worst([=](double x) { return elementary::pow(x, exponent); },
              [=](long double x) { return std::pow(x, static_cast<long double>(exponent)); }, 1e-17, 1e17),
        1);
  EXPECT_EQ(elementary::pow(-0.5, 3), -0.125);
  EXPECT_EQ(elementary::pow(0, 0), 1);
}

}  // namespace elementary_test
