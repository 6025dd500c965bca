#include "engine/free_flight.hpp"

#include <gsl/gsl_cdf.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/sample.hpp"

namespace free_flight_test {

using namespace lorentz;

ClosedChain chain_with(double gamma, bool random_direction = false) {
  return {5, 20, 1, 0.5, gamma, random_direction};
}

/// chi^2 of draws of the number of cells against the geometric law of probability p; 20 classes.
double chi_squared_of_cells(const FreeFlight& free_flight, double p) {
  constexpr std::size_t classes = 20;
  constexpr std::uint32_t particles = 100, flights = 1000;
  std::vector<double> counts(classes, 0);
  for (std::uint32_t particle = 0; particle < particles; ++particle) {
    for (std::uint64_t draws = 0; draws < flights;) {
      double u = 1;
      const auto cells = static_cast<std::size_t>(free_flight(particle, draws, u));
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
  // Finds: a scattering probability larger by a twentieth.
  EXPECT_LT(gsl_cdf_chisq_Q(chi_squared_of_cells(free_flight, 0.21), 19), 1e-4);
}

TEST(FreeFlight, DirectionsAreEvenlyDrawn) {
  const FreeFlight free_flight(chain_with(5, true), {3, 0}, chain_with(5).particles());
  std::vector<double> signs;
  for (std::uint64_t draws = 0; draws < 100000;) {
    double u = 2.5;
    EXPECT_EQ(free_flight(static_cast<std::uint32_t>(draws % 100), draws, u), 1);
    EXPECT_EQ(std::abs(u), 2.5);
    signs.push_back(u > 0 ? 1 : -1);
  }
  EXPECT_LT(std::abs(support::z_score(support::sample(signs), 0)), 4);
  EXPECT_GT(std::abs(support::z_score(support::sample(signs), 0.02)), 4);
}

TEST(FreeFlight, DrawsDependOnTheParticleAndItsOwnCountOnly) {
  const FreeFlight free_flight(chain_with(1), {3, 0}, chain_with(1).particles());
  double u = 1;
  std::vector<std::int64_t> first, second, other;
  std::uint64_t of_first = 0, of_second = 0, of_other = 0;
  for (int k = 0; k < 50; ++k) first.push_back(free_flight(7, of_first, u));
  for (int k = 0; k < 50; ++k) {
    other.push_back(free_flight(8, of_other, u));
    second.push_back(free_flight(100 + 7, of_second, u));  // the copy of particle 7
  }
  EXPECT_EQ(first, second);
  EXPECT_NE(first, other);
}

}  // namespace free_flight_test
