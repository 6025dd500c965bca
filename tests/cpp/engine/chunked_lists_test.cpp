#include "engine/chunked_lists.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace {

using lorentz::ChunkedLists;
using lorentz::Flight;

std::vector<std::uint32_t> particles_in(const ChunkedLists& lists, std::size_t list) {
  std::vector<std::uint32_t> particles;
  lists.for_each(list, [&](std::uint32_t place) { particles.push_back(lists[place].particle); });
  std::ranges::sort(particles);
  return particles;
}

std::vector<std::uint32_t> numbers(std::uint32_t begin, std::uint32_t end) {
  std::vector<std::uint32_t> all;
  for (; begin < end; ++begin) all.push_back(begin);
  return all;
}

void append(ChunkedLists& lists, std::size_t list, std::uint32_t begin, std::uint32_t end) {
  for (; begin < end; ++begin) lists.append(list, {1.5 * begin, -2.0 * begin, begin + 1, begin, begin + 2});
}

// Lengths around those at which a chunk is full.
TEST(ChunkedLists, HoldEveryFlightOnce) {
  for (const std::uint32_t count : {0U, 1U, 255U, 256U, 257U, 511U, 512U, 513U, 2000U}) {
    ChunkedLists lists;
    lists.reset(3, 10);
    append(lists, 0, 0, count);
    append(lists, 2, count, 2 * count);
    EXPECT_EQ(particles_in(lists, 0), numbers(0, count));
    EXPECT_TRUE(particles_in(lists, 1).empty());
    EXPECT_EQ(particles_in(lists, 2), numbers(count, 2 * count));
  }
}

TEST(ChunkedLists, KeepEveryMemberOfAFlight) {
  ChunkedLists lists;
  lists.reset(1, 1);
  const Flight& kept = lists[lists.append(0, {1, -2, 3, 4, 5})];
  EXPECT_EQ(kept.time, 1);
  EXPECT_EQ(kept.velocity, -2);
  EXPECT_EQ(kept.target, 3U);
  EXPECT_EQ(kept.particle, 4U);
  EXPECT_EQ(kept.draws, 5U);
}

TEST(ChunkedLists, PlacesStayWhenAListIsMoved) {
  ChunkedLists lists;
  lists.reset(2, 1);
  append(lists, 0, 0, 300);
  const std::uint32_t place = lists.append(0, {0, 0, 0, 300});
  lists.move(0, 1);
  EXPECT_TRUE(particles_in(lists, 0).empty());
  EXPECT_EQ(particles_in(lists, 1), numbers(0, 301));
  EXPECT_EQ(lists[place].particle, 300U);
}

TEST(ChunkedLists, MemoryOfAClearedListServesAgain) {
  ChunkedLists lists;
  lists.reset(2, 1);
  append(lists, 0, 0, 1000);
  append(lists, 1, 0, 300);
  const std::size_t places = lists.places();
  for (int round = 0; round < 3; ++round) {
    lists.clear(0);
    EXPECT_TRUE(particles_in(lists, 0).empty());
    append(lists, 0, 500, 1500);
    EXPECT_EQ(particles_in(lists, 0), numbers(500, 1500));
    EXPECT_EQ(particles_in(lists, 1), numbers(0, 300));
  }
  EXPECT_EQ(lists.places(), places);
}

}  // namespace
