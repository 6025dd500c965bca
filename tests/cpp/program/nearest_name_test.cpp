#include "program/nearest_name.hpp"

#include <gtest/gtest.h>

namespace {

using lorentz::nearest_name;

// Mutants: replacing costs two; deleting costs nothing; the last of several.
TEST(NearestName, HasTheFewestLettersToChange) {
  const std::vector<std::string> names{"sigma", "seed", "cells"};
  EXPECT_EQ(nearest_name("sigmma", names), "sigma");
  EXPECT_EQ(nearest_name("signa", names), "sigma");
  EXPECT_EQ(nearest_name("eed", names), "seed");
  EXPECT_EQ(nearest_name("cell", names), "cells");
  EXPECT_EQ(nearest_name("ab", {"cd", "a"}), "a");
  EXPECT_EQ(nearest_name("ab", {"aabb", "cb"}), "cb");
  EXPECT_EQ(nearest_name("", {"ab", "cd"}), "ab");
}

}  // namespace
