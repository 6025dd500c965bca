#include "engine/id_pool.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <vector>

namespace id_pool_test {

using lorentz::IdPool;

TEST(IdPool, CountsFromZero) {
  IdPool ids;
  for (std::uint32_t number = 0; number < 5; ++number) EXPECT_EQ(ids.take(), number);
}

// Mutant: the number that was given back first is taken first.
TEST(IdPool, TheLastOneBackIsTheFirstOut) {
  IdPool ids;
  for (int k = 0; k < 5; ++k) ids.take();
  for (const std::uint32_t number : {3U, 0U, 4U}) ids.give_back(number);
  for (const std::uint32_t number : {4U, 0U, 3U, 5U}) EXPECT_EQ(ids.take(), number);
}

// Mutant: a number that was given back stays among the free ones when it is taken.
TEST(IdPool, NoNumberIsTwiceInUseAndNoneIsWasted) {
  std::mt19937_64 generator(1);
  IdPool ids;
  std::set<std::uint32_t> used;
  std::size_t most = 0;
  for (int step = 0; step < 20'000; ++step) {
    if (used.empty() || generator() % 100 < 52) {
      const std::uint32_t number = ids.take();
      ASSERT_TRUE(used.insert(number).second) << number;
      most = std::max(most, used.size());
      ASSERT_LT(number, most);
    } else {
      const auto any = std::next(used.begin(), static_cast<std::ptrdiff_t>(generator() % used.size()));
      ids.give_back(*any);
      used.erase(any);
    }
  }
}

}  // namespace id_pool_test
