#include "program/stopping_rule.hpp"

#include <gsl/gsl_cdf.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <utility>
#include <vector>

namespace stopping_rule_test {

using namespace lorentz;

constexpr int seeds = 3000;
constexpr double significant = 4;  // significance threshold in standard errors

using Generator = std::mt19937_64;

/// A law of records of mean 1.
struct Law {
  double deviation;
  std::function<double(Generator&)> draw;
  bool relative;  // whether the target is relative
};

Law normal(bool relative) {
  return {0.3, [](Generator& g) { return std::normal_distribution(1., 0.3)(g); }, relative};
}

Law exponential(bool relative) {
  return {1, [](Generator& g) { return std::exponential_distribution(1.)(g); }, relative};
}

Law lognormal() {
  constexpr double s = 0.5;
  return {std::sqrt(std::expm1(s * s)),
          [](Generator& g) { return std::lognormal_distribution(-s * s / 2, s)(g); }, true};
}

/// Sums over records.
struct Sample {
  double replicas = 0, sum = 0, squares = 0;

  void add(double record) {
    replicas += 1;
    sum += record;
    squares += record * record;
  }
  double mean() const { return sum / replicas; }
  double error() const {
    return std::sqrt(std::max(0., squares / replicas - mean() * mean()) / (replicas - 1));
  }
};

using Looks = std::function<std::uint64_t(std::uint64_t)>;
using Stop = std::function<bool(std::uint64_t, double)>;

/// Adds records from look to look until `stop`, a function of their number and of the error over the target,
/// is true.
Sample until(const Law& law, double target, const Looks& next, const Stop& stop, Generator& generator) {
  Sample sample;
  for (std::uint64_t look = next(0);; look = next(look)) {
    while (sample.replicas < static_cast<double>(look)) sample.add(law.draw(generator));
    const double error = sample.error() / (law.relative ? sample.mean() : 1);
    if (stop(look, error / target)) return sample;
  }
}

/// Statistics of many runs whose target is the error of `ideal` replicas.
struct Runs {
  double inside[2] = {0, 0};   // parts of the runs within 1 and 2 standard errors of the truth
  double student[2] = {0, 0};  // these fractions for normal records
  double reached = 0;          // part whose true error is within the target
};

Runs many(const Law& law, double ideal, const Looks& next, const Stop& stop) {
  Runs runs;
  const double error = law.deviation / std::sqrt(ideal);
  for (int seed = 0; seed < seeds; ++seed) {
    Generator generator(static_cast<unsigned>(seed));
    const Sample sample = until(law, error, next, stop, generator);
    const double deviation = sample.mean() - 1, true_error = law.deviation / std::sqrt(sample.replicas);
    for (const int k : {1, 2}) {
      runs.inside[k - 1] += (std::abs(deviation) < k * sample.error()) / double{seeds};
      runs.student[k - 1] += (2 * gsl_cdf_tdist_P(k, sample.replicas - 1) - 1) / seeds;
    }
    runs.reached += (true_error <= error) / double{seeds};
  }
  return runs;
}

Runs by_rule(const Law& law, double ideal, std::uint64_t batch) {
  const StoppingRule rule{batch, 1'000'000};
  return many(law, ideal, [&](std::uint64_t used) { return rule.next_look(used); }, &StoppingRule::reached);
}

/// Mutant that ends a run as soon as the error is below the target, from the first batch with at least two
/// replicas on.
Runs at_once(const Law& law, double ideal, std::uint64_t batch) {
  const auto next = [=](std::uint64_t used) { return std::max<std::uint64_t>(used + batch, 2); };
  return many(law, ideal, next, [](std::uint64_t, double excess) { return excess <= 1; });
}

Runs given_in_advance(const Law& law, std::uint64_t replicas) {
  return many(law, 1, [=](std::uint64_t) { return replicas; }, [](std::uint64_t, double) { return true; });
}

/// Difference between the fractions of two sets of runs, in standard errors.
double difference(double fraction, double other, double other_variance) {
  return (fraction - other) / std::sqrt((fraction * (1 - fraction) + other_variance) / seeds);
}

const std::vector<std::uint64_t> batches = {1, 5, 16, 64};
const std::vector<double> ideals = {10, 60, 200};

TEST(StoppingRule, CoverageForNormalRecords) {
  for (const bool relative : {false, true})
    for (const std::uint64_t batch : batches)
      for (const double ideal : ideals) {
        const Runs runs = by_rule(normal(relative), ideal, batch);
        for (const int k : {0, 1})
          EXPECT_LT(std::abs(difference(runs.inside[k], runs.student[k], 0)), significant)
              << relative << ' ' << batch << ' ' << ideal << ": " << runs.inside[k] << " for "
              << runs.student[k];
        EXPECT_GT(difference(runs.reached, 0.95, 0), -significant)
            << batch << ' ' << ideal << ": " << runs.reached;
      }
  for (const std::uint64_t batch : {1, 5}) {
    const Runs mutant = at_once(normal(true), 60, batch);
    EXPECT_LT(difference(mutant.inside[1], mutant.student[1], 0), -significant) << mutant.inside[1];
    EXPECT_LT(difference(mutant.reached, 0.95, 0), -significant) << mutant.reached;
  }
}

// For skewed records a target increases the true error at most as much as 32 replicas given in advance would.
TEST(StoppingRule, CoverageForSkewedRecords) {
  for (const Law& law : {exponential(true), exponential(false), lognormal()}) {
    const Runs standard = given_in_advance(law, 32);
    const auto compare = [&](const Runs& runs, int k) {
      return difference(runs.inside[k], standard.inside[k], standard.inside[k] * (1 - standard.inside[k]));
    };
    for (const std::uint64_t batch : {1, 16, 64})
      for (const double ideal : {60., 200.}) {
        const Runs runs = by_rule(law, ideal, batch);
        for (const int k : {0, 1})
          EXPECT_GT(compare(runs, k), -significant)
              << batch << ' ' << ideal << ": " << runs.inside[k] << " for " << standard.inside[k];
      }
    EXPECT_LT(compare(at_once(law, 60, 1), 1), -significant);
    EXPECT_LT(compare(at_once(law, 20, 3), 1), -significant);
  }
}

// [eq. 49], of exponential records (s = 1, g = 2, v = 1) under both kinds of target, and of lognormal ones.
// Detected mistakes: another sign, the bias of the other kind of target.
TEST(StoppingRule, BiasIsThatOfFirstOrder) {
  constexpr double s = 0.5, w = 1.2840254166877414;  // exp(s^2)
  const double skewness = (w + 2) * std::sqrt(w - 1), variation = std::sqrt(std::expm1(s * s));
  const std::vector<std::pair<Law, double>> cases{{exponential(false), -2},
                                                  {exponential(true), 0},
                                                  {lognormal(), -(skewness - 2 * variation) * variation}};
  for (const auto& [law, factor] : cases) {
    const StoppingRule rule{5, 1'000'000};
    const auto next = [&](std::uint64_t used) { return rule.next_look(used); };
    double sum = 0, squares = 0, expected = 0;
    constexpr int runs = 20'000;
    for (int seed = 0; seed < runs; ++seed) {
      Generator generator(static_cast<unsigned>(seed));
      const Sample sample =
          until(law, law.deviation / std::sqrt(130), next, &StoppingRule::reached, generator);
      sum += sample.mean() - 1;
      squares += (sample.mean() - 1) * (sample.mean() - 1);
      expected += factor / sample.replicas;
    }
    const double error = std::sqrt(squares) / runs;
    EXPECT_LT(std::abs(sum - expected) / runs, 4 * error) << factor;
    if (factor < -1) {
      EXPECT_LT(sum / runs, -8 * error);
    }
  }
}

TEST(StoppingRule, LooksAtFixedNumbersOfReplicas) {
  const StoppingRule rule{10, 305};
  std::vector<std::uint64_t> looks;
  for (std::uint64_t used = 0; used < 300;) looks.push_back(used = rule.next_look(used));
  EXPECT_EQ(looks, (std::vector<std::uint64_t>{70, 80, 90, 100, 110, 120, 130, 140, 150, 160, 180, 200, 220,
                                               240, 270, 300}));
  EXPECT_EQ((StoppingRule{10, 25}.next_look(0)), 20U);  // limited by `most`
  EXPECT_EQ((StoppingRule{10, 5}.next_look(0)), 10U);   // the first batch is measured anyway
  EXPECT_FALSE(StoppingRule::reached(63, 0));
  EXPECT_TRUE(StoppingRule::reached(64, 0));
  EXPECT_FALSE(StoppingRule::reached(64, NAN));
}

}  // namespace stopping_rule_test
