#include "engine/closed_start.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "model/rules/elastic.hpp"
#include "support/plausible.hpp"

namespace closed_start_test {

using namespace lorentz;
using support::plausible;

const ClosedChain chain{{.cells = 1000, .cell_length = 0.5, .sigma = 0.3}, 50};
constexpr StartTemperatures temperatures{500, 80};

PhasePoint start() { return closed_chain_start(chain, temperatures, false, {1, 0}); }

/// Position of a particle in its cell, in [0, 1).
double place(std::size_t index, const Particle& particle) {
  return particle.position / chain.cell_length - static_cast<double>(index / chain.particles_per_cell);
}

/// chi^2 of the positions in 100 equal bins.
double evenness(const std::function<double(std::size_t)>& place_of) {
  std::vector<double> bins(100, 0);
  for (std::size_t i = 0; i < chain.particles(); ++i)
    bins.at(static_cast<std::size_t>(100 * place_of(i))) += 1;
  return support::unevenness(bins);
}

TEST(InitialState, PlacesParticlesEvenlyInTheirOwnCells) {
  const PhasePoint point = start();
  ASSERT_EQ(point.particles.size(), chain.particles());
  for (std::size_t i = 0; i < point.particles.size(); ++i) {
    ASSERT_GE(place(i, point.particles[i]), 0);
    ASSERT_LT(place(i, point.particles[i]), 1);
  }
  const auto place_of = [&](std::size_t i) { return place(i, point.particles[i]); };
  EXPECT_TRUE(plausible(evenness(place_of), 99));
  // Detected mistake: no particle starts in the last two hundredths of a cell.
  EXPECT_FALSE(plausible(evenness([&](std::size_t i) { return 0.98 * place_of(i); }), 99));
}

/// Sum of squared velocities over the temperature: chi^2 with one degree of freedom per velocity.
TEST(InitialState, DrawsVelocitiesAtTheTemperatures) {
  const PhasePoint point = start();
  ASSERT_EQ(point.scatterers.size(), chain.cells);
  double particles = 0, scatterers = 0, mean = 0;
  for (const Particle& particle : point.particles) {
    particles += particle.velocity * particle.velocity / temperatures.particles;
    mean += particle.velocity / chain.particles();
  }
  for (const double scatterer : point.scatterers)
    scatterers += scatterer * scatterer / temperatures.scatterers;
  EXPECT_TRUE(plausible(particles, chain.particles()));
  EXPECT_TRUE(plausible(scatterers, chain.cells));
  EXPECT_LT(std::abs(mean) / std::sqrt(temperatures.particles / chain.particles()), 4);
  // Detected mistakes: the temperature is the mean energy u^2/2; scatterers have the temperature of the
  // particles.
  EXPECT_FALSE(plausible(particles / 2, chain.particles()));
  EXPECT_FALSE(plausible(scatterers * temperatures.scatterers / temperatures.particles, chain.cells));
}

// The bound is the rounding error of a sum of that many numbers in double precision.
TEST(InitialState, ShiftsTheTotalMomentumToZero) {
  for (const double sigma : {-1.0, -0.9, 0.0, 0.3, 1 - 1e-12, 1.0}) {
    ClosedChain other = chain;
    other.sigma = sigma;
    const PhasePoint free = closed_chain_start(other, temperatures, false, {1, 0});
    const PhasePoint shifted = closed_chain_start(other, temperatures, true, {1, 0});
    EXPECT_EQ(free.scatterers, shifted.scatterers);
    const double root_mass = Elastic(sigma).root_mass();
    long double total = 0;
    double magnitude = 0;
    for (const Particle& particle : shifted.particles) {
      total += particle.velocity;
      magnitude += std::abs(particle.velocity);
    }
    for (const double scatterer : shifted.scatterers) {
      total += static_cast<long double>(root_mass) * scatterer;
      magnitude += root_mass * std::abs(scatterer);
    }
    EXPECT_LT(std::abs(total), 0x1p-53 * chain.particles() * magnitude) << sigma;

    const double shift = free.particles[0].velocity - shifted.particles[0].velocity;
    EXPECT_NE(shift, 0);
    for (std::size_t i = 0; i < free.particles.size(); ++i) {
      const double velocity = free.particles[i].velocity;
      ASSERT_NEAR(velocity - shifted.particles[i].velocity, shift,
                  0x1p-50 * (std::abs(velocity) + std::abs(free.particles[0].velocity) + std::abs(shift)));
    }
  }
}

}  // namespace closed_start_test
