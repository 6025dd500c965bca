#include "statistics/control_variates.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "numerics/matrix.hpp"

namespace control_variates_test {

using namespace lorentz;

/// y = 5 + 2 c_1 - 3 c_2 + noise, with skewed controls of mean 0.
Records noisy(std::size_t size, double noise, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::exponential_distribution<double> exponential;
  std::normal_distribution<double> normal;
  Records records(3);
  for (std::size_t i = 0; i < size; ++i) {
    const double a = exponential(generator) - 1, b = 100 * (exponential(generator) - 1);
    records.append(std::vector{5 + 2 * a - 0.03 * b + noise * normal(generator), a, b});
  }
  return records;
}

/// The columns first, ..., first + count - 1.
Columns columns(std::size_t first, std::size_t count) {
  Columns result(count);
  std::iota(result.begin(), result.end(), first);
  return result;
}

/// Regression of all columns except the last `controls` ones on these.
Regression on_last(const Records& records, std::size_t controls) {
  const std::size_t measured = records.width() - controls;
  return {columns(0, measured), columns(measured, controls)};
}

TEST(ControlVariates, UseCoefficientsOfTheOtherRecords) {
  const Records records = noisy(12, 1, 1);
  const Records reduced = *regress_out(records, on_last(records, 2));
  for (std::size_t left_out = 0; left_out < records.size(); ++left_out) {
    Matrix normal(3, 3);  // equations of the linear regression on 1, c_1, c_2
    std::vector<double> fit(3);
    for (std::size_t i = 0; i < records.size(); ++i) {
      if (i == left_out) continue;
      const double row[] = {1, records[i][1], records[i][2]};
      for (std::size_t k = 0; k < 3; ++k) {
        fit[k] += row[k] * records[i][0];
        for (std::size_t j = 0; j < 3; ++j) normal(k, j) += row[k] * row[j];
      }
    }
    LuFactors(normal).solve(fit);
    const double expected =
        records[left_out][0] - fit[1] * records[left_out][1] - fit[2] * records[left_out][2];
    EXPECT_NEAR(reduced[left_out][0], expected, 1e-12);
  }
}

TEST(ControlVariates, ThatDoNotVaryAreLeftOut) {
  Records records(4);
  const Records source = noisy(10, 0.1, 3);  // enough for two controls, not for three
  for (std::size_t i = 0; i < source.size(); ++i)
    records.append(std::vector{source[i][0], source[i][1], source[i][2], 1. / 3});
  const Records with = *regress_out(records, on_last(records, 3)),
                without = *regress_out(source, on_last(source, 2));
  for (std::size_t i = 0; i < source.size(); ++i) EXPECT_NEAR(with[i][0], without[i][0], 1e-12);
}

TEST(ControlVariates, AreNotUsedWhereTheyCannotBeRegressed) {
  const Records few = noisy(5, 1, 1);
  EXPECT_FALSE(regress_out(few, on_last(few, 2)));
  EXPECT_FALSE(regress_out(few, on_last(few, 0)));
  Records lonely(2);  // one record determines the coefficient
  for (int i = 0; i < 20; ++i) lonely.append(std::vector{std::sin(i), i == 3 ? 1. : 0.});
  EXPECT_FALSE(regress_out(lonely, on_last(lonely, 1)));
  const Group::Prepared unchanged = reduce_variance(few, {on_last(few, 2)});
  EXPECT_EQ(unchanged.control_variates->used, 0U);
  EXPECT_EQ(unchanged.control_variates->needed, 10U);
  EXPECT_EQ(unchanged.records.values(), few.values());
}

/// Controls that are independent of the columns increase the variance, relatively by about the ratio of the
/// numbers of controls and records.
TEST(ControlVariates, AreUsedOnlyIfTheyHelp) {
  int used = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    std::mt19937_64 generator(seed);
    std::normal_distribution<double> normal;
    Records unrelated(23);
    for (int i = 0; i < 32; ++i) {
      std::vector<double> row;
      for (int column = 0; column < 23; ++column) row.push_back(normal(generator));
      unrelated.append(row);
    }
    EXPECT_GT(variance_ratio(*regress_out(unrelated, on_last(unrelated, 3)), unrelated, columns(0, 20)), 0.9);
    const Group::Prepared chosen = reduce_variance(unrelated, {on_last(unrelated, 3)});
    used += chosen.control_variates->used > 0 ? 1 : 0;
    EXPECT_LE(variance_ratio(chosen.records, unrelated, columns(0, 20)), 1);
  }
  EXPECT_LT(used, 20);
  const Records related = noisy(30, 0.5, 1);
  EXPECT_EQ(reduce_variance(related, {on_last(related, 2)}).control_variates->used, 2U);
}

/// A column that is a linear function of the controls stays unchanged; regression would make it a constant
/// with an error of 0.
TEST(ControlVariates, LeaveColumnsThatTheyDetermine) {
  const Records source = noisy(30, 0.5, 1);
  Records records(4);  // measured, determined, two controls
  for (std::size_t i = 0; i < source.size(); ++i)
    records.append(
        std::vector{source[i][0], 7 + source[i][1] - 2 * source[i][2], source[i][1], source[i][2]});
  const Group::Prepared reduced = reduce_variance(records, {on_last(records, 2)});
  EXPECT_EQ(reduced.control_variates->used, 2U);
  for (std::size_t i = 0; i < records.size(); ++i) {
    EXPECT_EQ(reduced.records[i][1], records[i][1]);
    EXPECT_NE(reduced.records[i][0], records[i][0]);
  }
}

/// Each regression has its own controls; columns of no regression stay unchanged.
TEST(ControlVariates, AreRegressedGroupByGroup) {
  const Records source = noisy(30, 0.5, 1), other = noisy(30, 0.5, 2);
  Records records(6);
  for (std::size_t i = 0; i < source.size(); ++i)
    records.append(
        std::vector{source[i][0], source[i][1], source[i][2], other[i][0], other[i][1], other[i][2]});
  const Group::Prepared reduced = reduce_variance(records, {{{0}, {1, 2}}, {{3}, {4, 5}}});
  const Records first = *regress_out(source, on_last(source, 2));
  const Records second = *regress_out(other, on_last(other, 2));
  for (std::size_t i = 0; i < records.size(); ++i) {
    EXPECT_DOUBLE_EQ(reduced.records[i][0], first[i][0]);
    EXPECT_DOUBLE_EQ(reduced.records[i][3], second[i][0]);
    EXPECT_EQ(reduced.records[i][4], records[i][4]);
  }
}

}  // namespace control_variates_test
