#include "model/rules/elastic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace elastic_test {

using lorentz::Elastic;

constexpr double unit = 0x1p-53;  // largest relative error of one rounding

const std::vector<double> sigmas = {-1,  -1 + 1e-12, -0.9, -0.5,      -0.49999,    -1e-10,       0, 1e-10,
                                    0.3, 0.5,        0.9,  1 - 1e-12, 1 - 0x1p-53, -1 + 0x1p-53, 1};

/// Bound on the error of u' and U' in units of 2^-53 max(|u|, |U|). The worst case is U'. w = U / scale has
/// 2.5 roundings (1.5 of them from the scale), which enter with the weight |sigma|; the products with c and
/// the rest, and their sum, have one each, at magnitudes of at most 1, 1/2 and 3/2; the last sum has one, the
/// scale and the product with it 2.5, at |U'| <= sqrt(2). The total is below 10.5.
constexpr double roundings = 11;

struct Pair {
  double u, scatterer;
};

Pair collide(const Elastic& rule, Pair before) {
  double u = before.u;
  double w = before.scatterer / rule.scatterer_scale();
  rule(u, w, 0);
  return {u, rule.scatterer_scale() * w};
}

/// Velocities of comparable size, of sizes up to 12 decades apart, at rest, and equal.
std::vector<Pair> velocities() {
  std::vector<Pair> result = {{1, 0}, {0, 1}, {1, 1}, {1, -1}, {1e-300, 1}, {1, 1e-300}, {-0.75, 1e-9}};
  std::mt19937_64 generator(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> decades(-12, 12);
  for (int i = 0; i < 10000; ++i) {
    result.push_back({normal(generator), normal(generator)});
    result.push_back({normal(generator), std::pow(10.0, decades(generator)) * normal(generator)});
  }
  return result;
}

double larger(Pair pair) { return std::max(std::abs(pair.u), std::abs(pair.scatterer)); }

TEST(Elastic, EqualsTheClosedForm) {
  for (const double sigma : sigmas) {
    const Elastic rule(sigma);
    const long double s = rule.sigma();
    const long double c = std::sqrt((1 - s) * (1 + s));
    for (const Pair before : velocities()) {
      const Pair after = collide(rule, before);
      const double bound = roundings * unit * larger(before);
      ASSERT_LE(std::abs(after.u - (-s * before.u + c * before.scatterer)), bound) << sigma;
      ASSERT_LE(std::abs(after.scatterer - (c * before.u + s * before.scatterer)), bound) << sigma;
    }
  }
}

TEST(Elastic, HasEveryDigitOfSigmaNearTheLimits) {
  for (int k = 6; k <= 16; ++k)
    for (const double sign : {-1, 1})
      EXPECT_EQ(Elastic(sign * (1 - std::pow(10, -k))).sigma(), sign * (1 - std::pow(10, -k))) << k;
}

TEST(Elastic, IsExactAtEqualMassesAndAtTheLimits) {
  const Elastic exchange(0), wall(1), feather(-1);
  for (const Pair before : velocities()) {
    const Pair exchanged = collide(exchange, before);
    ASSERT_EQ(exchanged.u, before.scatterer);
    ASSERT_EQ(exchanged.scatterer, before.u);
    const Pair reflected = collide(wall, before);
    ASSERT_EQ(reflected.u, -before.u);
    ASSERT_EQ(reflected.scatterer, before.scatterer);
    const Pair passed = collide(feather, before);
    ASSERT_EQ(passed.u, before.u);
    ASSERT_EQ(passed.scatterer, -before.scatterer);
  }
}

}  // namespace elastic_test
