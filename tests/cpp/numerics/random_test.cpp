#include "numerics/random.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace random_test {

using lorentz::Purpose;
using lorentz::RandomStream;
using Counter = r123::Philox4x64::ctr_type;
using Key = r123::Philox4x64::key_type;

/// A 64-bit word as a number in [0, 1]; a uniform number keeps its leading 52 or 53 bits.
double fraction(std::uint64_t word) { return static_cast<double>(word) * 0x1p-64; }

// Philox gives every key and counter different words. Detected mistakes: a stream does not depend on the
// seed, the replica, the purpose or the entity; words are used twice.
TEST(Random, UniformReadsTheWordsOfTheStreamInOrder) {
  RandomStream stream({7, 5}, Purpose::initial_particle_momentum, 11);
  for (std::uint64_t block = 0; block < 3; ++block) {
    const Counter words = r123::Philox4x64()(
        Counter{{block, 11, 5, 0}}, Key{{7, static_cast<std::uint64_t>(Purpose::initial_particle_momentum)}});
    for (const std::uint64_t word : words) EXPECT_NEAR(stream.uniform(), fraction(word), 0x1p-52);
  }
}

TEST(Random, UniformExcludesBothEnds) {
  EXPECT_GT(RandomStream::unit_interval(0), 0);
  EXPECT_LT(RandomStream::unit_interval(~std::uint64_t{0}), 1);
}

// Sample means of x, x^2 and x^4 of a million draws. For the normal distribution they are 0, 1 and 3, with
// the variances 1, 2 and 96.
TEST(Random, GaussianHasTheMomentsOfTheNormalDistribution) {
  constexpr int draws = 1'000'000;
  RandomStream stream({1, 0}, Purpose::initial_position, 0);
  double sum = 0, squares = 0, fourth_powers = 0;
  for (int i = 0; i < draws; ++i) {
    const double x = stream.gaussian();
    sum += x;
    squares += x * x;
    fourth_powers += x * x * x * x;
  }
  EXPECT_NEAR(sum / draws, 0, 4 * std::sqrt(1. / draws));
  EXPECT_NEAR(squares / draws, 1, 4 * std::sqrt(2. / draws));
  EXPECT_NEAR(fourth_powers / draws, 3, 4 * std::sqrt(96. / draws));
}

}  // namespace random_test
