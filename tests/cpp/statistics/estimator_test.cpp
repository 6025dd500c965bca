#include "statistics/estimator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace {

using namespace lorentz;

struct Tallies : TallySchema {
  Axis place = numbered_axis("place", "Where", 2);
  ScalarTally a = tally("a", "1", "A number");
  ScalarTally b = tally("b", "1", "Another");
  Tally pair = tally("pair", {place}, "1", "Two, the first always 0");
};

Records records() {
  Records result(Tallies().width());
  for (const double x : {1., 2., 6.}) result.append(std::vector{x, 2 * x + 1, 0., x});
  return result;
}

// The error of a mean is s/sqrt(n); that of a ratio is written out with every replica left out.
// Mutants: the mean of ratios in place of the ratio of means; an error of the records in place of the mean.
TEST(Formulas, JackknifeTheMeanRecord) {
  const Tallies tallies;
  Formulas formulas;
  formulas.quantity("mean", "time", "A mean", [=](RecordView mean) { return mean[tallies.a]; });
  formulas.quantity("ratio", "1", "A ratio",
                    [=](RecordView mean) { return mean[tallies.a] / mean[tallies.b]; });
  const Results results = formulas.estimator().estimate(records());
  ASSERT_EQ(results.size(), 2U);
  EXPECT_EQ(results[0].what.name, "mean");
  EXPECT_EQ(results[0].what.units, "time");
  EXPECT_EQ(results[0].mean, std::vector{3.});
  EXPECT_NEAR(results[0].standard_error[0], std::sqrt(7. / 3), 1e-14);
  EXPECT_EQ(results[0].count, std::vector<std::uint64_t>{3});
  EXPECT_FALSE(results[0].control_variates.has_value());

  const std::vector<double> without = {4 / 9., 3.5 / 8, 1.5 / 4};
  double mean = 0, squares = 0;
  for (const double ratio : without) mean += ratio / 3;
  for (const double ratio : without) squares += (ratio - mean) * (ratio - mean);
  EXPECT_NEAR(results[1].standard_error[0], std::sqrt(2. / 3 * squares), 1e-14);
}

// Mutants: 0 as error of an empty bin; NaN for a number that is 0.
TEST(Formulas, AnElementThatIsZeroEverywhereHasNoError) {
  const Tallies tallies;
  Formulas formulas;
  formulas.quantity("pair", {tallies.place}, "1", "Two", mean_of(tallies.pair));
  formulas.quantity("zero", "1", "A number", [=](RecordView mean) { return mean[tallies.pair][0]; });
  const Results results = formulas.estimator().estimate(records());
  EXPECT_EQ(results[0].mean, (std::vector<double>{0, 3}));
  EXPECT_TRUE(std::isnan(results[0].standard_error[0]));
  EXPECT_GT(results[0].standard_error[1], 0);
  EXPECT_EQ(results[1].standard_error, std::vector<double>{0});
}

// Mutant: read once for every formula.
TEST(Formulas, ReadEveryMeanOnce) {
  const Tallies tallies;
  int reads = 0;
  Formulas<double> formulas([&](RecordView mean) {
    ++reads;
    return mean[tallies.a];
  });
  formulas.quantity("once", "1", "It", [](double value) { return value; });
  formulas.quantity("twice", "1", "Twice", [](double value) { return 2 * value; });
  EXPECT_EQ(formulas.descriptions().size(), 2U);
  const Results results = formulas.estimator().estimate(records());
  EXPECT_EQ(results[1].mean, std::vector{6.});
  EXPECT_EQ(reads, 4);  // of all records, and without each of three
}

// Mutants: the records as they were; control variates said to be used always.
TEST(Formulas, OfCorrectedRecords) {
  const Tallies tallies;
  Formulas formulas;
  formulas.quantity("mean", "1", "A mean", [=](RecordView mean) { return mean[tallies.a]; });
  const auto negative = [](const Records& given) {
    Records result(given.width());
    for (std::size_t i = 0; i < given.size(); ++i) {
      std::vector<double> row(given[i].begin(), given[i].end());
      for (double& value : row) value = -value;
      result.append(row);
    }
    return result;
  };
  EXPECT_EQ(formulas.estimator_of(negative).estimate(records())[0].mean, std::vector{-3.});
  for (const bool used : {false, true}) {
    const auto correction = [&](const Records& given) { return ReducedRecords{negative(given), used}; };
    const Results results = formulas.estimator(correction).estimate(records());
    EXPECT_EQ(results[0].mean, std::vector{-3.});
    EXPECT_EQ(results[0].control_variates, used);
  }
}

// Mutants: the first error, or the second, not noticed.
TEST(Estimate, RefusesOtherThanDescribed) {
  const auto values = [](std::size_t count) {
    return [count](RecordView) { return std::vector<double>(count, 1); };
  };
  const std::vector<Description> described = {{"one", "1", "1", {}},
                                              {"two", "1", "2", {numbered_axis("place", "Where", 2)}}};
  EXPECT_EQ(estimate(records(), described, values(3)).size(), 2U);
  EXPECT_THROW(estimate(records(), described, values(2)), std::logic_error);
  EXPECT_THROW(estimate(records(), described, values(4)), std::logic_error);
}

// Mutant: only the total is compared, so that one value too many and one too few shift names silently.
TEST(Formulas, OfAnotherSizeThanTheirAxesAreRefused) {
  const Tallies tallies;
  Formulas formulas;
  formulas.quantity("long", {tallies.place}, "1", "Three values for two places",
                    [](RecordView) { return std::vector<double>(3); });
  formulas.quantity("short", {tallies.place}, "1", "One value for two places",
                    [](RecordView) { return std::vector<double>(1); });
  EXPECT_THROW(formulas.estimator().estimate(records()), std::logic_error);
}

}  // namespace
