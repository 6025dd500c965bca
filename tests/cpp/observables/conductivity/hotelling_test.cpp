#include "observables/conductivity/hotelling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "statistics/control_variates.hpp"
#include "support/columns.hpp"

namespace hotelling_test {

using namespace lorentz;

/// Three correlated columns of mean `drift` standard errors, the third one of very small scale; two control
/// variates that explain half of their variance.
Records drifting(std::size_t size, double drift, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  Records records(5);
  for (std::size_t i = 0; i < size; ++i) {
    const double shared = normal(generator), a = normal(generator), b = normal(generator);
    const double shift = drift / std::sqrt(static_cast<double>(size));
    const double own_a = normal(generator), own_b = normal(generator);
    records.append(std::vector{0.5 * shared + a + own_a + 1.5 * shift, 0.5 * shared + b + own_b,
                               1e-200 * (shared + normal(generator)), a, b});
  }
  return records;
}

/// Number of p-values below the level in 2000 trials.
template <class PValue>
int rejected(double level, double drift, const PValue& p_value) {
  int count = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed)
    count += p_value(drifting(24, drift, seed)) < level ? 1 : 0;
  return count;
}

double plain(const Records& records) { return zero_mean_p_value(records, support::columns(0, 3), 0); }

double reduced(const Records& records) {
  return zero_mean_p_value(*regress_out(records, support::on_last(records, 2)), support::columns(0, 3), 2);
}

/// Whether a count in 2000 trials is within four standard deviations of 2000 times the level.
bool has_size(int count, double level) {
  return std::abs(count - 2000 * level) < 4 * std::sqrt(2000 * level * (1 - level));
}

TEST(Hotelling, RejectsAsOftenAsItsLevelSays) {
  for (const double level : {0.01, 0.1}) {
    EXPECT_TRUE(has_size(rejected(level, 0, plain), level));
    EXPECT_TRUE(has_size(rejected(level, 0, reduced), level));
  }
  // Detected mistake: chi^2 with 3 degrees of freedom, the limit of many records, gives 0.01 where F gives
  // 0.035.
  EXPECT_FALSE(has_size(rejected(0.035, 0, plain), 0.01));
}

TEST(Hotelling, FindsDrifts) {
  EXPECT_GT(rejected(0.01, 5, plain), 1500);
  EXPECT_GT(rejected(0.01, 5, reduced), 1900);  // the controls remove half of the noise
  EXPECT_LT(rejected(0.01, 1, plain), 400);
}

TEST(Hotelling, CountsAColumnThatIsThereTwiceOnce) {
  const Records source = drifting(24, 3, 1);
  Records once(1), twice(2);
  for (std::size_t i = 0; i < source.size(); ++i) {
    once.append(std::vector{source[i][0]});
    twice.append(std::vector{source[i][0], -1e100 * source[i][0]});
  }
  EXPECT_NEAR(zero_mean_p_value(once, support::columns(0, 1), 0),
              zero_mean_p_value(twice, support::columns(0, 2), 0), 1e-12);
}

}  // namespace hotelling_test
