#include "engine/stationary_start.hpp"

#include <gsl/gsl_sf_expint.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/plausible.hpp"
#include "support/sample.hpp"

namespace stationary_start_test {

using namespace lorentz;
using support::plausible;

const ClosedChain chain{{.cells = 4000, .cell_length = 0.5}};
constexpr StationaryMeasure measure{.fugacity = 3, .temperature = 4, .slowest = 0.2};
constexpr double zeta = 1.5;

PhasePoint start() { return stationary_start(chain, measure, {1, 0}); }

/// Number of particles in every cell.
std::vector<double> numbers(const PhasePoint& point) {
  std::vector<double> numbers(chain.cells, 0);
  for (const Particle& particle : point.particles)
    numbers.at(static_cast<std::size_t>(particle.position / chain.cell_length)) += 1;
  return numbers;
}

/// chi^2 of 20 x 20 equal bins of two numbers in [0, 1).
template <class Pair>
double evenness(const PhasePoint& point, const Pair& pair_of) {
  std::vector<double> bins(400, 0);
  for (const Particle& particle : point.particles) {
    const auto [x, y] = pair_of(particle);
    bins.at(20 * static_cast<std::size_t>(20 * x) + static_cast<std::size_t>(20 * y)) += 1;
  }
  return support::unevenness(bins);
}

/// Fraction of the density exp(-p^2/2T)/p on p > slowest at momenta above that of a particle.
double faster(const Particle& particle) {
  const auto above = [](double p) { return gsl_sf_expint_E1(p * p / (2 * measure.temperature)); };
  return above(std::abs(particle.velocity)) / above(measure.slowest);
}

// The numbers of particles are Poissonian: their mean is 2 zeta Lambda, their variance equals it, and
// neighbouring cells are uncorrelated. Detected mistakes: the mean is 2 z Lambda; every cell has the same
// number.
TEST(StationaryStart, NumbersOfParticlesArePoissonian) {
  const std::vector<double> found = numbers(start());
  const double ratio = measure.slowest * measure.slowest / (2 * measure.temperature);
  const double mean = zeta * gsl_sf_expint_E1(ratio);
  EXPECT_NEAR(mean_number(chain, measure), mean, 1e-12 * mean);
  double squares = 0, products = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    squares += (found[i] - mean) * (found[i] - mean) / mean;
    products += (found[i] - mean) * (found[(i + 1) % found.size()] - mean) / mean;
  }
  const double cells = chain.cells;
  EXPECT_LT(std::abs(support::z_score(support::sample(found), mean)), 4);
  EXPECT_GT(std::abs(support::z_score(support::sample(found), mean / chain.cell_length)), 10);
  EXPECT_LT(std::abs(squares - cells) / std::sqrt(cells * (2 + 1 / mean)), 4);
  EXPECT_LT(std::abs(products) / std::sqrt(cells), 4);
}

// Detected mistake: momenta have the density p exp(-p^2/2T) of the flux, without the factor of the time that
// a particle spends in a cell.
TEST(StationaryStart, SpeedsFollowTheirDensityIndependentlyOfPositions) {
  const PhasePoint point = start();
  const double length = chain.cells * chain.cell_length;
  const auto pair = [&](const Particle& one) { return std::pair(faster(one), one.position / length); };
  for (const Particle& particle : point.particles) ASSERT_GT(std::abs(particle.velocity), measure.slowest);
  EXPECT_TRUE(plausible(evenness(point, pair), 399));
  EXPECT_FALSE(plausible(evenness(point,
                                  [&](const Particle& one) {
                                    const double p = one.velocity;
                                    return std::pair(std::exp(-p * p / (2 * measure.temperature)),
                                                     one.position / length);
                                  }),
                         399));
}

}  // namespace stationary_start_test
