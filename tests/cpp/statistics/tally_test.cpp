#include "statistics/tally.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace tally_test {

using namespace lorentz;

struct Tallies : TallySchema {
  Axis place = numbered_axis("place", "Where", 3, 1), side{"side", "1", "Which", {-1, 1}};
  ScalarTally number = tally("number", "1", "A number");
  Tally table = tally("table", {side, place}, "energy", "An array");
  ScalarTally last = tally("last", "time", "Another number");
};

// Detected mistakes: the width excludes the last tally; the size of a tally is that of its first axis alone.
TEST(TallySchema, KeepsTalliesInOrder) {
  const Tallies tallies;
  EXPECT_EQ(tallies.width(), 8U);
  EXPECT_EQ(columns_of({tallies.last, tallies.table}), (Columns{7, 1, 2, 3, 4, 5, 6}));

  EXPECT_EQ(tallies.tallies().size(), 3U);
  const Description& table = tallies.description(tallies.table);
  EXPECT_EQ(table.name, "table");
  EXPECT_EQ(table.units, "energy");
  EXPECT_EQ(table.description, "An array");
  EXPECT_EQ(table.axes[1].values, (std::vector<double>{1, 2, 3}));
  EXPECT_TRUE(tallies.description(tallies.last).axes.empty());
  EXPECT_THROW((void)tallies.description(Tally{1, 5}), std::logic_error);
}

// Detected mistakes: a new record is not zero; the span of a tally begins at the first tally.
TEST(TallySums, AreReadAndWrittenByTheirHandles) {
  const Tallies tallies;
  TallySums sums(tallies);
  EXPECT_EQ(sums.values(), std::vector<double>(8, 0));
  sums[tallies.number] += 2;
  sums[tallies.table][4] = 3;
  sums[tallies.last] = 5;
  EXPECT_EQ(sums.values(), (std::vector<double>{2, 0, 0, 0, 0, 3, 0, 5}));

  const TallyMeans view(sums.values());
  EXPECT_EQ(view[tallies.number], 2);
  EXPECT_EQ(view[tallies.last], 5);
  EXPECT_TRUE(std::ranges::equal(view[tallies.table], sums[tallies.table]));
}

// Detected mistake: an array with fewer or more values is copied without a message.
TEST(TallySums, RefuseArraysOfAnotherSize) {
  const Tallies tallies;
  TallySums sums(tallies);
  sums.set(tallies.table, std::vector<double>{1, 2, 3, 4, 5, 6});
  EXPECT_EQ(sums.values(), (std::vector<double>{0, 1, 2, 3, 4, 5, 6, 0}));
  EXPECT_THROW(sums.set(tallies.table, std::vector<double>(5)), std::out_of_range);
  EXPECT_THROW(sums.set(tallies.table, std::vector<double>(7)), std::out_of_range);
  EXPECT_THROW(Records(2).append(std::vector<double>(1)), std::invalid_argument);
}

}  // namespace tally_test
