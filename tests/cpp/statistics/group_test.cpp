#include "statistics/group.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

namespace group_test {

using namespace lorentz;

struct Tallies : TallySchema {
  Axis place = numbered_axis("place", "Where", 2);
  ScalarTally a = tally("a", "1", "A number");
  ScalarTally b = tally("b", "1", "Another");
};

Records records() {
  Records result(Tallies().width());
  for (const double x : {1., 2., 6.}) result.append(std::vector{x, 2 * x + 1});
  return result;
}

// The error of a ratio is calculated here from the ratios without one replica each. Detected mistake: the
// mean of ratios in place of the ratio of means.
TEST(Group, JackknifesFormulasOfTheMeanRecord) {
  const Tallies tallies;
  Group group;
  group.quantity("ratio", "1", "A ratio", [=](TallyMeans mean) { return mean[tallies.a] / mean[tallies.b]; });
  const Results results = group.estimate(records());
  EXPECT_NEAR(results[0].mean[0], 3. / 7, 1e-15);
  EXPECT_EQ(results[0].count, std::vector<std::int64_t>{3});
  EXPECT_FALSE(results[0].control_variates.has_value());

  const std::vector<double> without = {4 / 9., 3.5 / 8, 1.5 / 4};
  double mean = 0, squares = 0;
  for (const double ratio : without) mean += ratio / 3;
  for (const double ratio : without) squares += (ratio - mean) * (ratio - mean);
  EXPECT_NEAR(results[0].standard_error[0], std::sqrt(2. / 3 * squares), 1e-14);
}

// Detected mistakes: uncorrected records are used; control variates are always reported as used.
TEST(Group, EstimatesFromPreparedRecords) {
  const Tallies tallies;
  Records prepared(tallies.width());
  prepared.append(std::vector{-3., 1.});
  for (const std::optional<ControlVariates>& used : {std::optional<ControlVariates>(), {{0, 9}}, {{2, 9}}}) {
    Group corrected([&](const Records&) { return Group::Prepared{prepared, used}; });
    corrected.quantity("mean", "1", "A mean", [=](TallyMeans mean) { return mean[tallies.a]; });
    const Results results = corrected.estimate(records());
    EXPECT_EQ(results[0].mean, std::vector{-3.});
    ASSERT_EQ(results[0].control_variates.has_value(), used.has_value());
    EXPECT_EQ(results[0].control_variates.value_or(ControlVariates{}).used,
              used.value_or(ControlVariates{}).used);
  }
}

// Detected mistake: only the total number of values is compared, so that one value too many and one too few
// assign values to wrong names without a message.
TEST(Group, RefusesFormulasOfAnotherSizeThanTheirAxes) {
  const Tallies tallies;
  Group group;
  group.quantity("long", {tallies.place}, "1", "Three values for two places",
                 [](TallyMeans) { return std::vector<double>(3); });
  group.quantity("short", {tallies.place}, "1", "One value for two places",
                 [](TallyMeans) { return std::vector<double>(1); });
  EXPECT_THROW(group.estimate(records()), std::logic_error);
}

TEST(TallySums, RefuseATallyOfAnotherSize) {
  TallySchema schema;
  const Tally row = schema.tally("profile", {numbered_axis("cell", "Cell", 3)}, "1", "Three numbers");
  EXPECT_THROW(TallySums(schema).set(row, std::vector<double>{1, 2}), std::out_of_range);
}

}  // namespace group_test
