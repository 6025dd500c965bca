#include "engine/free_flight.hpp"

#include <gsl/gsl_cdf.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace free_flight_test {

using namespace lorentz;

ClosedChain chain_with(double gamma) { return {{.cells = 5, .gamma = gamma}, 20}; }

/// chi^2 of draws of the number of cells against the geometric law of probability p; 20 classes.
double chi_squared_of_cells(const FreeFlight& free_flight, double p) {
  constexpr std::size_t classes = 20;
  constexpr std::uint32_t particles = 100, flights = 1000;
  std::vector<double> counts(classes, 0);
  for (std::uint32_t particle = 0; particle < particles; ++particle) {
    for (std::uint64_t draw = 0; draw < flights; ++draw) {
      const auto cells = static_cast<std::size_t>(free_flight.cells(particle, draw));
      ++counts[std::min(cells, classes) - 1];
    }
  }
  double sum = 0;
  for (std::size_t k = 0; k < classes; ++k) {
    const double passed = std::pow(1 - p, static_cast<double>(k));
    const double expected = particles * flights * (k + 1 < classes ? passed * p : passed);
    sum += (counts[k] - expected) * (counts[k] - expected) / expected;
  }
  return sum;
}

TEST(FreeFlight, CellsAreGeometric) {
  const FreeFlight free_flight(chain_with(1), {3, 0}, chain_with(1).particles());
  EXPECT_GT(gsl_cdf_chisq_Q(chi_squared_of_cells(free_flight, 0.2), 19), 1e-4);
  // Detected mistake: the scattering probability is larger by a twentieth.
  EXPECT_LT(gsl_cdf_chisq_Q(chi_squared_of_cells(free_flight, 0.21), 19), 1e-4);
}

}  // namespace free_flight_test
