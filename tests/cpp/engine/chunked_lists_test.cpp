#include "engine/chunked_lists.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace chunked_lists_test {

using lorentz::ChunkedLists;
using lorentz::Flight;

std::vector<std::uint32_t> particles_in(const ChunkedLists& lists, ChunkedLists::List list) {
  std::vector<std::uint32_t> particles;
  lists.for_each(list, [&](std::uint32_t slot) { particles.push_back(lists[slot].particle); });
  std::ranges::sort(particles);
  return particles;
}

std::vector<std::uint32_t> numbers(std::uint32_t begin, std::uint32_t end) {
  std::vector<std::uint32_t> all;
  for (; begin < end; ++begin) all.push_back(begin);
  return all;
}

void append(ChunkedLists& lists, ChunkedLists::List& list, std::uint32_t begin, std::uint32_t end) {
  for (; begin < end; ++begin) lists.append(list, {1.5 * begin, -2.0 * begin, begin + 1, begin, begin + 2});
}

// Lengths around those at which a chunk is full.
TEST(ChunkedLists, HoldEveryFlightOnce) {
  for (const std::uint32_t count : {0U, 1U, 255U, 256U, 257U, 511U, 512U, 513U, 2000U}) {
    ChunkedLists lists;
    lists.reset(10, 2);
    ChunkedLists::List one = 0, other = 0;
    for (std::uint32_t number = 0; number < count; ++number) {  // by turns, so that their chunks alternate
      append(lists, one, number, number + 1);
      append(lists, other, count + number, count + number + 1);
    }
    EXPECT_EQ(particles_in(lists, one), numbers(0, count));
    EXPECT_EQ(particles_in(lists, other), numbers(count, 2 * count));
  }
}

TEST(ChunkedLists, KeepEveryMemberOfAFlight) {
  ChunkedLists lists;
  lists.reset(1, 1);
  ChunkedLists::List list = 0;
  const Flight& kept = lists[lists.append(list, {1, -2, 3, 4, 5})];
  EXPECT_EQ(kept.time, 1);
  EXPECT_EQ(kept.velocity, -2);
  EXPECT_EQ(kept.target, 3U);
  EXPECT_EQ(kept.particle, 4U);
  EXPECT_EQ(kept.draws, 5U);
}

TEST(ChunkedLists, PlacesStayAsTheListGrows) {
  ChunkedLists lists;
  lists.reset(1, 1);
  ChunkedLists::List list = 0;
  const std::uint32_t slot = lists.append(list, {0, 0, 0, 300});
  append(lists, list, 0, 300);
  EXPECT_EQ(particles_in(lists, list), numbers(0, 301));
  EXPECT_EQ(lists[slot].particle, 300U);
}

TEST(ChunkedLists, MemoryOfAClearedListServesAgain) {
  ChunkedLists lists;
  lists.reset(1, 2);
  ChunkedLists::List one = 0, other = 0;
  append(lists, one, 0, 1000);
  append(lists, other, 0, 300);
  const std::size_t slots = lists.slots();
  for (int round = 0; round < 3; ++round) {
    lists.clear(one);
    EXPECT_TRUE(particles_in(lists, one).empty());
    append(lists, one, 500, 1500);
    EXPECT_EQ(particles_in(lists, one), numbers(500, 1500));
    EXPECT_EQ(particles_in(lists, other), numbers(0, 300));
  }
  EXPECT_EQ(lists.slots(), slots);
}

}  // namespace chunked_lists_test
