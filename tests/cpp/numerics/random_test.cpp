#include "numerics/random.hpp"

#include <gtest/gtest.h>

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

}  // namespace random_test
