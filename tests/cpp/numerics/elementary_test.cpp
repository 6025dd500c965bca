#include <gsl/gsl_sf_expint.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace elementary_test {

constexpr double tiny = 5e-324, huge = 1e308;

/// Largest error in units in the last place relative to long double, at logarithmically spaced arguments from
/// low to high.
template <class Function, class Exact>
double worst(Function function, Exact exact, double low, double high) {
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> exponent(std::log(low), std::log(high));
  double worst = 0;
  for (int i = 0; i < 20'000; ++i) {
    const double x = std::min(high, std::exp(exponent(generator)));
    const long double value = exact(static_cast<long double>(x));
    const auto rounded = static_cast<double>(std::abs(value));
    const double unit = std::nextafter(rounded, std::numeric_limits<double>::infinity()) - rounded;
    worst = std::max(worst, static_cast<double>(std::abs(function(x) - value) / unit));
  }
  return worst;
}

#define EXPECT_ULP(bound, low, high, expression)                                                             \
  EXPECT_LE(worst([](double x) { return expression; }, [](long double x) { return expression; }, low, high), \
            bound)

TEST(ElementaryFunctions, AreWithinTheirErrors) {
  EXPECT_ULP(1, 1e-300, 700, std::exp(-x));
  EXPECT_ULP(1, 1e-300, 1000, std::exp2(-x));
  EXPECT_ULP(1, 1e-300, 700, std::expm1(-x));
  EXPECT_ULP(3.5, tiny, huge, std::log(x));
  EXPECT_ULP(3.5, 0.5, 2, std::log(x));
  EXPECT_ULP(1, tiny, huge, std::log2(x));
  EXPECT_ULP(1, tiny, huge, std::log10(x));
  EXPECT_ULP(1, 1e-300, 0.999, std::log1p(-x));
  EXPECT_ULP(3.5, 1e-300, 100, std::sin(x));
  EXPECT_ULP(3.5, 1e-300, 100, std::cos(x));
  EXPECT_ULP(1, 1e-300, 100, std::tan(x));
  EXPECT_ULP(1, 1e-300, 1, std::asin(x));
  EXPECT_ULP(1, 1e-300, 1, std::acos(-x));
  EXPECT_ULP(1, 1e-300, huge, std::atan(x));
  EXPECT_ULP(1, 1e-100, 1e100, std::atan2(x, decltype(x)(-2.5)));
  EXPECT_ULP(1, 1e-300, 700, std::sinh(x));
  EXPECT_ULP(1, 1e-300, 700, std::cosh(x));
  EXPECT_ULP(1.001, 1e-300, 20, std::tanh(x));  // stated: 1
  EXPECT_ULP(1, 1e-300, 1e100, std::asinh(x));
  EXPECT_ULP(1, 1, 1e100, std::acosh(x));
  EXPECT_ULP(1, 1e-300, 0.999, std::atanh(x));
  EXPECT_ULP(1, tiny, huge, std::cbrt(x));
  EXPECT_ULP(1, 1e-300, 10, std::erf(x));
  EXPECT_ULP(1.5, 1e-300, 5, std::erfc(x));
  EXPECT_ULP(1, 1e-17, 1e17, std::pow(x, decltype(x)(0.3)));
  EXPECT_ULP(1, 1e-17, 1e17, std::pow(x, decltype(x)(17)));
  EXPECT_ULP(1, 1e-100, 1e100, std::hypot(x, decltype(x)(0.7)));
}

// Detected mistake: an underflow aborts the program.
TEST(ElementaryFunctions, MayUnderflowInGsl) { EXPECT_EQ(gsl_sf_expint_E1(710), 0); }

}  // namespace elementary_test
