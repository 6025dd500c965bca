#include <gsl/gsl_sf_expint.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace elementary_test {

template <class Real>
using Function = Real (*)(Real);
using Pairs = std::vector<std::pair<Function<double>, Function<long double>>>;

/// Every function agrees with its form in extended precision, at x and at 2x.
void expect_agreement(const Pairs& pairs, double x) {
  for (std::size_t k = 0; k < pairs.size(); ++k)
    for (const double each : {x, 2 * x})
      EXPECT_NEAR(static_cast<double>(pairs[k].first(each) / pairs[k].second(each)), 1, 0x1p-50) << k;
}

// Detected mistake: a name that has another function.
TEST(ElementaryFunctions, AreWhatTheirNamesSay) {
  expect_agreement(
      {{exp, expl},     {exp2, exp2l}, {expm1, expm1l}, {log, logl},   {log2, log2l},   {log10, log10l},
       {log1p, log1pl}, {sin, sinl},   {cos, cosl},     {tan, tanl},   {asin, asinl},   {acos, acosl},
       {atan, atanl},   {sinh, sinhl}, {cosh, coshl},   {tanh, tanhl}, {asinh, asinhl}, {atanh, atanhl},
       {cbrt, cbrtl},   {erf, erfl},   {erfc, erfcl}},
      0.37);
  expect_agreement({{acosh, acoshl}}, 1.3);
  const double x = 1.7, y = -2.5;
  EXPECT_DOUBLE_EQ(pow(x, y), static_cast<double>(powl(x, y)));
  EXPECT_DOUBLE_EQ(atan2(x, y), static_cast<double>(atan2l(x, y)));
  EXPECT_DOUBLE_EQ(hypot(x, y), static_cast<double>(hypotl(x, y)));
}

// Detected mistake: an underflow aborts the program.
TEST(ElementaryFunctions, MayUnderflowInGsl) { EXPECT_EQ(gsl_sf_expint_E1(710), 0); }

}  // namespace elementary_test
