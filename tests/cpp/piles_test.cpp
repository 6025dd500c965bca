#include "engine/piles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace {

using lorentz::Flight;
using lorentz::Piles;

std::vector<std::uint32_t> particles_in(const Piles& piles, std::size_t pile) {
  std::vector<std::uint32_t> particles;
  piles.for_each(pile, [&](std::uint32_t place) { particles.push_back(piles[place].particle); });
  std::ranges::sort(particles);
  return particles;
}

std::vector<std::uint32_t> numbers(std::uint32_t begin, std::uint32_t end) {
  std::vector<std::uint32_t> all;
  for (; begin < end; ++begin) all.push_back(begin);
  return all;
}

void append(Piles& piles, std::size_t pile, std::uint32_t begin, std::uint32_t end) {
  for (; begin < end; ++begin) piles.append(pile, {1.5 * begin, -2.0 * begin, begin + 1, begin, begin + 2});
}

// Lengths around those at which a chunk is full.
TEST(Piles, HoldEveryFlightOnce) {
  for (const std::uint32_t count : {0U, 1U, 254U, 255U, 256U, 510U, 511U, 2000U}) {
    Piles piles;
    piles.reset(3, 10);
    append(piles, 0, 0, count);
    append(piles, 2, count, 2 * count);
    EXPECT_EQ(particles_in(piles, 0), numbers(0, count));
    EXPECT_TRUE(particles_in(piles, 1).empty());
    EXPECT_EQ(particles_in(piles, 2), numbers(count, 2 * count));
  }
}

TEST(Piles, KeepEveryMemberOfAFlight) {
  Piles piles;
  piles.reset(1, 1);
  const Flight& kept = piles[piles.append(0, {1, -2, 3, 4, 5})];
  EXPECT_EQ(kept.time, 1);
  EXPECT_EQ(kept.velocity, -2);
  EXPECT_EQ(kept.target, 3U);
  EXPECT_EQ(kept.particle, 4U);
  EXPECT_EQ(kept.draws, 5U);
}

TEST(Piles, PlacesStayWhenAPileIsMoved) {
  Piles piles;
  piles.reset(2, 1);
  append(piles, 0, 0, 300);
  const std::uint32_t place = piles.append(0, {0, 0, 0, 300});
  piles.move(0, 1);
  EXPECT_TRUE(particles_in(piles, 0).empty());
  EXPECT_EQ(particles_in(piles, 1), numbers(0, 301));
  EXPECT_EQ(piles[place].particle, 300U);
}

TEST(Piles, MemoryOfAClearedPileServesAgain) {
  Piles piles;
  piles.reset(2, 1);
  append(piles, 0, 0, 1000);
  append(piles, 1, 0, 300);
  const std::size_t places = piles.places();
  for (int round = 0; round < 3; ++round) {
    piles.clear(0);
    EXPECT_TRUE(particles_in(piles, 0).empty());
    append(piles, 0, 500, 1500);
    EXPECT_EQ(particles_in(piles, 0), numbers(500, 1500));
    EXPECT_EQ(particles_in(piles, 1), numbers(0, 300));
  }
  EXPECT_EQ(piles.places(), places);
}

}  // namespace
