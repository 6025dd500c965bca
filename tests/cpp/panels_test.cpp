#include "boltzmann/panels.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

/// Largest relative error of the integral of a power up to the degree, over [0, 2].
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

// Of all orders that levels of resolution ask for, and the least.
TEST(Panels, GaussRuleIsExactUpToItsDegree) {
  for (const int order : {1, 2, 5, 14, 20, 28, 40, 56, 79}) {
    EXPECT_LT(worst_error(order, 2 * order - 1), 2e-14) << order;
    if (order < 14) {
      EXPECT_GT(worst_error(order, 2 * order), 1e-6) << order;
    }
  }
}

}  // namespace
