#include "boltzmann/panels.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace panels_test {

/// Largest relative error of the integrals over [0, 2] of the powers up to the degree.
double worst_error(int order, int degree) {
  const lorentz::Panels panels({0, 2}, order);
  double worst = 0;
  for (int n = 0; n <= degree; ++n) {
    const double exact = std::pow(2., n + 1) / (n + 1);
    worst =
        std::max(worst, std::abs(panels.weights().dot(panels.nodes().array().pow(n).matrix()) / exact - 1));
  }
  return worst;
}

// All orders that occur in levels of resolution, and lower ones.
TEST(Panels, GaussRuleIsExactUpToItsDegree) {
  for (const int order : {1, 2, 5, 14, 20, 28, 40, 56, 79}) {
    EXPECT_LT(worst_error(order, 2 * order - 1), 2e-14) << order;
    if (order < 14) {
      EXPECT_GT(worst_error(order, 2 * order), 1e-6) << order;
    }
  }
}

}  // namespace panels_test
