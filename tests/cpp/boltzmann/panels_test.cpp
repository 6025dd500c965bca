#include "boltzmann/panels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace panels_test {

using namespace lorentz;
using Eigen::Index;
using Eigen::VectorXd;

const std::vector<double> breaks{0, 1, 2.5, 7};
const Panels panels(breaks, 14);

/// Values of p^power at the nodes.
VectorXd power(const Panels& on, int exponent) {
  return on.nodes().unaryExpr([=](double p) { return std::pow(p, exponent); });
}

// Detected mistake: a rule with one node less.
TEST(Panels, IntegratePolynomialsUpToTwiceTheirOrder) {
  for (const int order : {1, 2, 3, 14, 40}) {
    const Panels one({0, 1, 3}, order);
    const auto error = [&](int exponent) {
      const double exact = std::pow(3, exponent + 1) / (exponent + 1);
      return std::abs(one.weights().dot(power(one, exponent)) / exact - 1);
    };
    EXPECT_LT(error(2 * order - 1), 1e-13) << order;
    EXPECT_GT(error(2 * order), order < 4 ? 1e-4 : 0) << order;
  }
}

// Detected mistake: a point at a break belongs to no panel.
TEST(Panels, InterpolateAndIntegratePolynomialsBelowTheirOrder) {
  const VectorXd points = (VectorXd(6) << 0, 0.3, 1, 2.4, 2.5, 7).finished();
  for (const int exponent : {0, 1, 13}) {
    const VectorXd values = panels.interpolation(points) * power(panels, exponent);
    const VectorXd integrals = panels.integration(points) * power(panels, exponent);
    for (Index i = 0; i < points.size(); ++i) {
      const double scale = std::pow(breaks[panels.panel(points[i]) + 1], exponent + 1);
      EXPECT_NEAR(values[i] / scale, std::pow(points[i], exponent) / scale, 1e-13)
          << exponent << ' ' << points[i];
      EXPECT_NEAR(integrals[i] / scale, std::pow(points[i], exponent + 1) / (exponent + 1) / scale, 1e-13)
          << exponent << ' ' << points[i];
    }
  }
  EXPECT_EQ((panels.interpolation(VectorXd::Constant(1, 7.1)) * power(panels, 0))[0], 0);
}

/// The integrals of p exp(i k p) in closed form. Detected mistakes: the downward recurrence of the spherical
/// Bessel functions starts with the wrong ratio; the sign of a power of i.
TEST(Panels, HaveTheFourierIntegralsOfPolynomials) {
  const double end = 7;
  for (const double k : {0.2, 1., 3., 10., 100., 3000.}) {
    const FourierIntegrals found = panels.fourier(VectorXd::Constant(1, k));
    const VectorXd p = power(panels, 1);
    const double cosine = (std::cos(k * end) - 1) / (k * k) + end * std::sin(k * end) / k;
    const double sine = std::sin(k * end) / (k * k) - end * std::cos(k * end) / k;
    EXPECT_NEAR((found.cosine * p)[0], cosine, 2e-13 * end / k) << k;
    EXPECT_NEAR((found.sine * p)[0], sine, 2e-13 * end / k) << k;
    EXPECT_NEAR((found.cosine_minus_one * p)[0], cosine - end * end / 2, 2e-13 * end * end) << k;
  }
}

TEST(Panels, HaveNoCancellationInTheCosineMinusOne) {
  const double k = 1e-7, end = 7;
  const double found = (panels.fourier(VectorXd::Constant(1, k)).cosine_minus_one * power(panels, 1))[0];
  EXPECT_NEAR(found / (-k * k * std::pow(end, 4) / 8), 1, 1e-13);
}

}  // namespace panels_test
