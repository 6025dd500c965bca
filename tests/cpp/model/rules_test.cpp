#include "model/rules.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

#include "support/rules.hpp"
#include "support/sample.hpp"

namespace rules_test {

using namespace lorentz;

constexpr std::uint64_t collisions = 100'000;
const std::vector<double> sigmas = {-0.9, -0.3, 0, 0.5, 0.8};

struct Velocities {
  double u, U, neighbour;  // of the particle, of the scatterer and of the next one
};

/// Collisions of independent normal u and U, before and after.
struct Encounters {
  std::vector<Velocities> before, after;
};

Encounters encounters(const Rules& any, std::uint64_t seed) {
  Encounters seen;
  RandomStream normal({seed, 0}, Purpose::initial_particle_momentum, 0);
  for (std::uint64_t count = 0; count < collisions; ++count) {
    double u = normal.gaussian();
    const double U = normal.gaussian(), scale = masses(any).scatterer_scale(), other = normal.gaussian();
    double w = U / scale, neighbour = other / scale;
    seen.before.push_back({u, U, other});
    std::visit(
        [&]<class Rule>(const Rule& rule) {
          RandomStream random({seed, 0}, Purpose::collision, 0, count);
          if constexpr (NeighbourRule<Rule>) {
            rule(u, w, neighbour, 0, random);
          } else if constexpr (RandomRule<Rule>) {
            rule(u, w, 0, random);
          } else {
            rule(u, w, 0);
          }
        },
        any);
    seen.after.push_back({u, scale * w, scale * neighbour});
  }
  return seen;
}

double largest_change(const Encounters& seen, auto&& value) {
  double largest = 0;
  for (std::size_t k = 0; k < collisions; ++k)
    largest = std::max(largest, std::abs(value(seen.after[k]) - value(seen.before[k])));
  return largest;
}

/// Absolute z-scores of the means of products that vanish for independent normal u and U.
std::vector<double> scores(const std::vector<Velocities>& all) {
  std::vector<std::vector<double>> products(11);
  for (const auto& [u, U, V] : all) {
    const double u2 = u * u - 1, U2 = U * U - 1, V2 = V * V - 1;
    const std::vector<double> values = {u,  U,     u * U, u2,     U2, u2 * U2, std::abs(u) * U,
                                        V2, u * V, U * V, U2 * V2};
    for (std::size_t k = 0; k < values.size(); ++k) products[k].push_back(values[k]);
  }
  std::vector<double> scores;
  for (const std::vector<double>& each : products)
    scores.push_back(std::abs(support::z_score(support::sample(each), 0)));
  return scores;
}

// Every rule conserves energy, leaves the measure invariant, and conserves momentum if it states so. Detected
// mistakes: a rule without one of the three.
TEST(Rules, HaveTheirProperties) {
  for (const RuleProperties& rule : rules::all) {
    for (const double sigma : sigmas) {
      const Rules any = make_rule(support::example(rule), sigma);
      const double root_mass = masses(any).root_mass();
      const Encounters seen = encounters(any, 1);
      const double energy = largest_change(
          seen, [](const Velocities& v) { return v.u * v.u + v.U * v.U + v.neighbour * v.neighbour; });
      const double momentum =
          largest_change(seen, [&](const Velocities& v) { return v.u + root_mass * (v.U + v.neighbour); });
      EXPECT_LT(energy, 1e-12) << rule.name << " " << sigma;
      EXPECT_EQ(momentum < 1e-12, rule.conserves_momentum) << rule.name << " " << sigma;
      const double largest = std::ranges::max(scores(seen.after));
      EXPECT_LT(largest, 5) << rule.name << " " << sigma;
    }
  }
}

/// Frequency of the collisions with value(velocities) of opposite sign after two rules, and of equal
/// magnitude.
support::Sample reversals(const Encounters& one, const Encounters& other, auto&& value) {
  std::vector<double> reversed;
  for (std::size_t k = 0; k < collisions; ++k) {
    const double a = value(one.after[k]), b = value(other.after[k]);
    EXPECT_EQ(std::abs(a), std::abs(b)) << k;
    reversed.push_back(a == b ? 0 : 1);
  }
  return support::sample(reversed);
}

// The speeds after a collision are those of the elastic rule, bit for bit. Detected mistakes: the sign of the
// particle is kept, or that of the scatterer is drawn too, in one rule; vice versa in the other one; the
// complement of the probability is used.
TEST(Rules, AreElasticButForASign) {
  const auto particle = [](const Velocities& v) { return v.u; };
  const auto scatterer = [](const Velocities& v) { return v.U; };
  const Encounters elastic = encounters(Elastic(0.4), 1), drawn = encounters(RandomDirection(0.4), 1);
  EXPECT_LT(std::abs(support::z_score(reversals(drawn, elastic, particle), 0.5)), 4);
  EXPECT_EQ(reversals(drawn, elastic, scatterer).mean, 0);
  const Encounters reversed = encounters(Reversal(0.4, 0.03), 1);
  EXPECT_LT(std::abs(support::z_score(reversals(reversed, elastic, scatterer), 0.03)), 4);
  EXPECT_EQ(reversals(reversed, elastic, particle).mean, 0);
  EXPECT_EQ(reversals(encounters(Reversal(0.4, 0), 1), elastic, scatterer).mean, 0);
  EXPECT_NEAR(reversals(encounters(Reversal(0.4, 1), 1), elastic, scatterer).mean, 1, 1e-9);
}

/// Velocities after the collision alone, and after the rotation that follows it with probability 1.
std::vector<std::pair<Velocities, Velocities>> rotations(double sigma) {
  const Encounters elastic = encounters(Elastic(sigma), 1), rotated = encounters(Rotation(sigma, 1), 1);
  std::vector<std::pair<Velocities, Velocities>> pairs;
  for (std::size_t k = 0; k < collisions; ++k) pairs.emplace_back(elastic.after[k], rotated.after[k]);
  return pairs;
}

// The mean over the circle is its centre, and every velocity is exchanged with every other at equal rates:
// the mean of f(before) g(after) is that of g(before) f(after). Detected mistakes: half of the circle is
// used; the neighbour gets energy only.
TEST(Rules, RotationIsUniformAndReversible) {
  for (const double sigma : sigmas) {
    const double root_mass = Elastic(sigma).root_mass(), square = 1 + 2 * root_mass * root_mass;
    std::vector<std::vector<double>> values(6);
    for (const auto& [one, other] : rotations(sigma)) {
      const double along = (one.u + root_mass * (one.U + one.neighbour)) / square;
      values[0].push_back((other.u - along) * one.u);
      values[1].push_back((other.U - root_mass * along) * one.U);
      values[2].push_back((other.neighbour - root_mass * along) * one.neighbour);
      values[3].push_back(one.u * one.u * other.U * other.U - other.u * other.u * one.U * one.U);
      values[4].push_back(one.u * other.neighbour - other.u * one.neighbour);
      values[5].push_back(one.u * other.U - other.u * one.U);
    }
    for (const std::vector<double>& each : values)
      EXPECT_LT(std::abs(support::z_score(support::sample(each), 0)), 4) << sigma;
  }
}

// The paper's formula and the form used here are one map, but for rounding and the change of sigma by 1e-11.
TEST(Rules, PrintedIsElastic) {
  for (const double sigma : sigmas) {
    const Encounters one = encounters(Elastic(sigma), 1), other = encounters(Printed(sigma), 1);
    for (std::size_t k = 0; k < 1000; ++k) {
      EXPECT_NEAR(one.after[k].u, other.after[k].u, 1e-9);
      EXPECT_NEAR(one.after[k].U, other.after[k].U, 1e-9);
    }
  }
}

}  // namespace rules_test
