#include "model/rules.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <variant>
#include <vector>

#include "support/rules.hpp"
#include "support/sample.hpp"

namespace rules_test {

using namespace lorentz;

constexpr std::uint64_t collisions = 100'000;
const std::vector<double> sigmas = {-0.9, -0.3, 0, 0.5, 0.8};

struct Velocities {
  double u, U;  // of the particle and of the scatterer
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
    const double U = normal.gaussian(), scale = masses(any).scatterer_scale();
    double w = U / scale;
    seen.before.push_back({u, U});
    std::visit(
        [&]<class Rule>(const Rule& rule) {
          if constexpr (RandomRule<Rule>) {
            RandomStream random({seed, 0}, Purpose::collision, 0, count);
            rule(u, w, 0, random);
          } else {
            rule(u, w, 0);
          }
        },
        any);
    seen.after.push_back({u, scale * w});
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
  std::vector<std::vector<double>> products(7);
  for (const auto& [u, U] : all) {
    const double u2 = u * u - 1, U2 = U * U - 1;
    const std::vector<double> values = {u, U, u * U, u2, U2, u2 * U2, std::abs(u) * U};
    for (std::size_t k = 0; k < values.size(); ++k) products[k].push_back(values[k]);
  }
  std::vector<double> scores;
  for (const std::vector<double>& each : products)
    scores.push_back(std::abs(support::z_score(support::sample(each), 0)));
  return scores;
}

// Every rule has the three properties that it declares. Detected mistakes: any of the three is declared
// wrongly.
TEST(Rules, HaveThePropertiesThatTheyState) {
  for (const RuleProperties& rule : rules::all) {
    for (const double sigma : sigmas) {
      const Rules any = make_rule(support::example(rule), sigma);
      const double root_mass = masses(any).root_mass();
      const Encounters seen = encounters(any, 1);
      const double energy = largest_change(seen, [](const Velocities& v) { return v.u * v.u + v.U * v.U; });
      const double momentum =
          largest_change(seen, [&](const Velocities& v) { return v.u + root_mass * v.U; });
      EXPECT_EQ(energy < 1e-12, rule.conserves_energy) << rule.name << " " << sigma;
      EXPECT_EQ(momentum < 1e-12, rule.conserves_momentum) << rule.name << " " << sigma;
      const double largest = std::ranges::max(scores(seen.after));
      EXPECT_EQ(largest < 5, rule.invariant == InvariantMeasure::maxwellian) << rule.name << " " << largest;
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

}  // namespace rules_test
