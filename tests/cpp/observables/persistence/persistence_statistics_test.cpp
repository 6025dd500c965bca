#include <gsl/gsl_cdf.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/closed_dynamics.hpp"
#include "engine/closed_start.hpp"
#include "reference/heap_simulator.hpp"
#include "support/sample.hpp"

namespace persistence_statistics_test {

using namespace lorentz;

constexpr double relaxation_time = 20;
constexpr double end_time = 40;
constexpr std::uint64_t replicas = 40;
constexpr std::size_t quantities = 3;

/// Means over the collisions of one replica: the fraction with p' p > 0, and the energies of the particle and
/// of the scatterer before the collision. Both are divided by the mean initial energy of a particle, which
/// contributes most to their variance between replicas.
class Encounters {
 public:
  explicit Encounters(const PhasePoint& start) {
    for (const Particle& particle : start.particles) unit_ += 0.5 * particle.velocity * particle.velocity;
    unit_ /= static_cast<double>(start.particles.size());
  }
  void add(double before, double after, double particle_energy, double scatterer_energy) {
    count_ += 1;
    sums_[0] += before * after > 0 ? 1 : 0;
    sums_[1] += particle_energy / unit_;
    sums_[2] += scatterer_energy / unit_;
  }
  void on_collision(const Collision& c) {
    add(c.particle_before, c.particle_after, 0.5 * c.particle_before * c.particle_before,
        0.5 * c.scatterer_before * c.scatterer_before);
  }
  double mean(std::size_t quantity) const { return sums_[quantity] / count_; }

 private:
  double unit_ = 0;
  double count_ = 0;
  std::array<double, quantities> sums_{};
};

using Samples = std::array<support::Sample, quantities>;

/// Mean of every quantity over the replicas with its standard error. encounters(replica) measures one
/// replica.
template <class Measure>
Samples over_replicas(const Measure& encounters) {
  std::array<std::vector<double>, quantities> values;
  for (std::uint64_t replica = 0; replica < replicas; ++replica) {
    const Encounters measured = encounters(replica);
    for (std::size_t k = 0; k < quantities; ++k) values[k].push_back(measured.mean(k));
  }
  Samples samples{};
  for (std::size_t k = 0; k < quantities; ++k) samples[k] = support::sample(values[k]);
  return samples;
}

ClosedChain chain_of(double sigma) { return {11, 20, 1, sigma}; }

PhasePoint start(double sigma, std::uint64_t seed, std::uint64_t replica) {
  return closed_chain_start(chain_of(sigma), {500, 0}, false, {seed, replica});
}

Samples engine(double sigma, std::uint64_t seed) {
  return over_replicas([=](std::uint64_t replica) {
    const PhasePoint begin = start(sigma, seed, replica);
    ClosedDynamics dynamics(chain_of(sigma), begin, end_time, {seed, replica});
    NoObserver nobody;
    simulate(dynamics, relaxation_time, nobody, [](double) {});
    Encounters sums(begin);
    simulate(dynamics, end_time, sums, [](double) {});
    return sums;
  });
}

Samples reference_simulator(double sigma, std::uint64_t seed) {
  return over_replicas([=](std::uint64_t replica) {
    const PhasePoint begin = start(sigma, seed, replica);
    auto simulator = reference::heap_simulator<double>(sigma, chain_of(sigma).cell_length, begin);
    const double mass = simulator.scatterer_mass();
    reference::HeapSimulator<double>::Event event{};
    while (simulator.step(relaxation_time, event)) {
    }
    Encounters sums(begin);
    while (simulator.step(end_time, event))
      sums.add(event.p_before, event.p_after, 0.5 * event.p_before * event.p_before,
               0.5 * event.P_before * event.P_before / mass);
    return sums;
  });
}

// The two simulators diverge at the first two arrivals whose order depends on rounding, so only their
// statistics agree. Every sample has its own seed: the scores are independent, and their sum over the seven
// mass ratios detects a small common bias.
TEST(PersistenceStatistics, EngineAgreesWithTheReference) {
  const std::vector<double> sigmas = {-0.9, -0.6, -0.3, 0, 0.3, 0.6, 0.9};
  std::array<double, quantities> chi_squared{};
  for (std::size_t i = 0; i < sigmas.size(); ++i) {
    const Samples ours = engine(sigmas[i], 100 + i);
    const Samples theirs = reference_simulator(sigmas[i], 200 + i);
    for (std::size_t k = 0; k < quantities; ++k) {
      const double z = support::z_score(ours[k], theirs[k]);
      EXPECT_LT(std::abs(z), 4) << "sigma " << sigmas[i] << ", quantity " << k;
      chi_squared[k] += z * z;
    }
  }
  const auto degrees_of_freedom = static_cast<double>(sigmas.size());
  for (const double sum : chi_squared) {
    EXPECT_GT(gsl_cdf_chisq_P(sum, degrees_of_freedom), 1e-4);
    EXPECT_GT(gsl_cdf_chisq_Q(sum, degrees_of_freedom), 1e-4);
  }
}

TEST(PersistenceStatistics, TellsApartTheSignOfSigma) {
  const double z = support::z_score(engine(0.3, 1)[0], reference_simulator(-0.3, 2)[0]);
  EXPECT_GT(std::abs(z), 10);
}

// Power of the scores: an error of sigma of 0.05 is detected.
TEST(PersistenceStatistics, TellsApartCloseMassRatios) {
  const double z = support::z_score(engine(0.3, 1)[0], reference_simulator(0.35, 2)[0]);
  EXPECT_GT(std::abs(z), 4);
}

}  // namespace persistence_statistics_test
