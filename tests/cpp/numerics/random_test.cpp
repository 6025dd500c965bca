#include "numerics/random.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>

namespace random_test {

using lorentz::Purpose;
using lorentz::RandomStream;
using Counter = r123::Philox4x64::ctr_type;
using Key = r123::Philox4x64::key_type;

/// Known answers for Philox4x64-10 in Random123's test vectors (kat_vectors).
TEST(Random, PhiloxGivesThePublishedTestVectors) {
  constexpr std::uint64_t ones = ~std::uint64_t{0};
  const r123::Philox4x64 philox;
  EXPECT_EQ(philox(Counter{}, Key{}),
            (Counter{{0x16554d9eca36314c, 0xdb20fe9d672d0fdc, 0xd7e772cee186176b, 0x7e68b68aec7ba23b}}));
  EXPECT_EQ(philox(Counter{{ones, ones, ones, ones}}, Key{{ones, ones}}),
            (Counter{{0x87b092c3013fe90b, 0x438c3c67be8d0224, 0x9cc7d7c69cd777b6, 0xa09caebf594f0ba0}}));
  EXPECT_EQ(philox(Counter{{0x243f6a8885a308d3, 0x13198a2e03707344, 0xa4093822299f31d0, 0x082efa98ec4e6c89}},
                   Key{{0x452821e638d01377, 0xbe5466cf34e90c6c}}),
            (Counter{{0xa528f45403e61d95, 0x38c72dbd566e9788, 0xa5a1610e72fd18b5, 0x57bd43b5e52b7fe6}}));
}

/// A 64-bit word as a number in [0, 1]; a uniform number keeps its leading 52 or 53 bits.
double fraction(std::uint64_t word) { return static_cast<double>(word) * 0x1p-64; }

TEST(Random, UniformReadsTheWordsOfTheStreamInOrder) {
  RandomStream stream({7, 5}, Purpose::initial_particle_momentum, 11);
  for (std::uint64_t block = 0; block < 3; ++block) {
    const Counter words = r123::Philox4x64()(
        Counter{{block, 11, 5, 0}}, Key{{7, static_cast<std::uint64_t>(Purpose::initial_particle_momentum)}});
    for (const std::uint64_t word : words) EXPECT_NEAR(stream.uniform(), fraction(word), 0x1p-52);
  }
}

// The numbers follow the Box-Muller formula. The second block shows that each number uses two words.
TEST(Random, GaussianIsTheBoxMullerTransformOfTwoWords) {
  RandomStream gaussians({3, 2}, Purpose::initial_position, 0),
      uniforms({3, 2}, Purpose::initial_position, 0);
  for (int i = 0; i < 4; ++i) {
    const double first = uniforms.uniform();
    const double second = uniforms.uniform();
    EXPECT_DOUBLE_EQ(gaussians.gaussian(),
                     std::sqrt(-2 * std::log(first)) * std::cos(2 * std::numbers::pi * second));
  }
  EXPECT_EQ(gaussians.uniform(), uniforms.uniform());
}

TEST(Random, StreamsDiffer) {
  std::set<double> numbers;
  std::size_t streams = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed)
    for (std::uint64_t purpose = 0; purpose < 3; ++purpose)
      for (std::uint64_t replica = 0; replica < 4; ++replica)
        for (std::uint64_t entity = 0; entity < 4; ++entity, ++streams) {
          RandomStream stream({seed, replica}, static_cast<Purpose>(purpose), entity);
          for (int i = 0; i < 8; ++i) numbers.insert(stream.uniform());
        }
  EXPECT_EQ(numbers.size(), 8 * streams);
}

TEST(Random, UniformExcludesBothEnds) {
  EXPECT_GT(RandomStream::unit_interval(0), 0);
  EXPECT_LT(RandomStream::unit_interval(~std::uint64_t{0}), 1);
}

/// z-scores of the sample means of x, x^2 and x^4 of a million draws, which are 0, 1 and 3 for the normal
/// distribution, with the variances 1, 2 and 96.
std::array<double, 3> z_scores(const std::function<double()>& draw) {
  constexpr double draws = 1e6;
  constexpr std::array<double, 3> mean{0, 1, 3}, variance{1, 2, 96};
  std::array<double, 3> sum{}, z{};
  for (int i = 0; i < static_cast<int>(draws); ++i) {
    const double x = draw(), square = x * x;
    sum[0] += x;
    sum[1] += square;
    sum[2] += square * square;
  }
  for (std::size_t k = 0; k < 3; ++k) z[k] = (sum[k] / draws - mean[k]) / std::sqrt(variance[k] / draws);
  return z;
}

// Detected mistakes: two common errors of the radius in the Box-Muller formula; the cosine of half the angle.
TEST(Random, GaussianHasTheMomentsOfTheNormalDistribution) {
  RandomStream stream({1, 0}, Purpose::initial_position, 0);
  for (const double z : z_scores([&] { return stream.gaussian(); })) EXPECT_LT(std::abs(z), 4);
  const auto direction = [&] { return std::cos(2 * std::numbers::pi * stream.uniform()); };
  const auto no_root = [&] { return -2 * std::log(stream.uniform()) * direction(); };
  const auto no_factor = [&] { return std::sqrt(-std::log(stream.uniform())) * direction(); };
  const auto half_turn = [&] {
    return std::sqrt(-2 * std::log(stream.uniform())) * std::cos(std::numbers::pi * stream.uniform() / 2);
  };
  EXPECT_GT(std::abs(z_scores(no_root)[1]), 10);
  EXPECT_GT(std::abs(z_scores(no_factor)[1]), 10);
  EXPECT_GT(std::abs(z_scores(half_turn)[0]), 10);
}

}  // namespace random_test
