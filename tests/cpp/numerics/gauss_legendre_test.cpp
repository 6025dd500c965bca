#include "numerics/gauss_legendre.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace gauss_legendre_test {

using namespace lorentz;
using Eigen::Index;
using Eigen::VectorXd;

/// Largest error of the integrals of P_0 ... P_degree, which are 2, 0, 0, ...
double worst_error(const GaussRule& rule, int degree) {
  VectorXd integrals = VectorXd::Zero(degree + 1);
  for (Index i = 0; i < rule.nodes.size(); ++i)
    integrals += rule.weights[i] * legendre_polynomials(degree, rule.nodes[i]);
  integrals[0] -= 2;
  return integrals.cwiseAbs().maxCoeff();
}

// Detected mistakes: the rule has one node less; it is claimed to be exact for one degree more.
TEST(GaussLegendre, IsExactUpToItsDegreeAndNoFurther) {
  for (const int order : {1, 2, 3, 5, 14, 20, 28, 40, 79}) {
    EXPECT_LT(worst_error(gauss_legendre(order), 2 * order - 1), 1e-13) << order;
    EXPECT_GT(worst_error(gauss_legendre(order), 2 * order), 1e-2) << order;
    if (order > 1) {
      EXPECT_GT(worst_error(gauss_legendre(order - 1), 2 * order - 1), 1e-2) << order;
    }
  }
}

TEST(GaussLegendre, HasTheKnownNodesAndWeights) {
  const GaussRule one = gauss_legendre(1), two = gauss_legendre(2), three = gauss_legendre(3);
  EXPECT_NEAR(one.nodes[0], 0, 1e-16);
  EXPECT_NEAR(one.weights[0], 2, 1e-15);
  EXPECT_NEAR(two.nodes[1], std::sqrt(1. / 3), 1e-15);
  EXPECT_NEAR(two.weights[0], 1, 1e-15);
  EXPECT_NEAR(three.nodes[0], -std::sqrt(0.6), 1e-15);
  EXPECT_NEAR(three.weights[1], 8. / 9, 1e-15);
  EXPECT_NEAR(three.weights[2], 5. / 9, 1e-15);
}

// Newton's method could converge to the same root twice.
TEST(GaussLegendre, NodesAscendInsideAndMirrorEachOther) {
  for (const int order : {2, 7, 30, 79, 200}) {
    const GaussRule rule = gauss_legendre(order);
    EXPECT_GT(rule.nodes[0], -1) << order;
    for (Index i = 1; i < order; ++i) ASSERT_GT(rule.nodes[i], rule.nodes[i - 1]) << order;
    EXPECT_LT((rule.nodes + rule.nodes.reverse()).cwiseAbs().maxCoeff(), 1e-15) << order;
    EXPECT_LT((rule.weights - rule.weights.reverse()).cwiseAbs().maxCoeff(), 1e-14) << order;
  }
}

TEST(LegendrePolynomials, AreThoseOfBonnetsRecurrence) {
  for (const double x : {-1., -0.3, 0., 0.77, 1.}) {
    const VectorXd p = legendre_polynomials(12, x);
    EXPECT_EQ(p[0], 1);
    EXPECT_EQ(p[1], x);
    for (Index n = 1; n < 12; ++n) {
      const auto order = static_cast<double>(n);
      EXPECT_NEAR((order + 1) * p[n + 1], (2 * order + 1) * x * p[n] - order * p[n - 1], 1e-14);
    }
  }
  EXPECT_EQ(legendre_polynomials(5, 1 + 1e-15), legendre_polynomials(5, 1));
}

}  // namespace gauss_legendre_test
