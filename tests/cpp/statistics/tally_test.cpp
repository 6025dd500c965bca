#include "statistics/tally.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace tally_test {

using namespace lorentz;

TEST(TallySums, NameTheTallyOfAnotherSize) {
  TallySchema schema;
  schema.tally("number", "1", "A number");
  const Tally row = schema.tally("profile", {numbered_axis("cell", "Cell", 3)}, "1", "Three numbers");
  TallySums sums(schema);
  sums.set(row, std::vector<double>{1, 2, 5});
  EXPECT_EQ(sums.values(), (std::vector<double>{0, 1, 2, 5}));
  try {
    sums.set(row, std::vector<double>{1, 2});
    FAIL() << "accepted";
  } catch (const std::out_of_range& error) {
    EXPECT_NE(std::string(error.what()).find("profile"), std::string::npos);
  }
}

}  // namespace tally_test
