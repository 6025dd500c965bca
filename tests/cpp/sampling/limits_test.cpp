#include "sampling/limits.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "support/refusal.hpp"

namespace limits_test {

using namespace lorentz;
using support::refusal, support::refused_as;

constexpr Reservoir bath(double temperature) { return {1, temperature}; }

// Detected mistakes: a bound itself is refused; the condition is !(value < low || value > high), which
// accepts NaN.
TEST(Limits, AcceptTheirBoundsAndNothingBeyond) {
  const auto check = [](double value) {
    return refusal([&] { require_within(value, 1, 2, "--a, --b", "their product"); });
  };
  EXPECT_EQ(check(1), "");
  EXPECT_EQ(check(2), "");
  EXPECT_EQ(
      check(3),
      "--a, --b: their product would be 3, which is not in [1, 2]: outside, numbers lose precision or the "
      "run does not end. Choose other values or other units.");
  EXPECT_NE(check(0.999), "");
  EXPECT_NE(check(std::numeric_limits<double>::quiet_NaN()), "");
}

// Detected mistake: only one of the reservoirs is checked.
TEST(Limits, OfTemperaturesWhoseFourthPowersOfMomentaAreStored) {
  const auto check = [](double left, double right) {
    return refusal([&] { require_fourth_powers(bath(left), bath(right)); });
  };
  EXPECT_EQ(check(1e140, 1e-140), "");
  EXPECT_NE(check(1e141, 1), "");
  EXPECT_NE(check(1, 1e141), "");
  EXPECT_NE(check(1e-141, 1), "");
}

// Detected mistakes: only one of the reservoirs is checked; only the rate or only the window is checked;
// another power of the temperature is checked.
TEST(Limits, OfCurrents) {
  const auto check = [](Reservoir left, Reservoir right, double duration, int power) {
    return refusal([&] { require_finite_currents({.left = left, .right = right}, duration, power); });
  };
  const Reservoir cold{1, 1}, hot{1, 1e290};
  for (const auto& [left, right] : {std::pair(cold, hot), std::pair(hot, cold)}) {
    EXPECT_EQ(check(left, right, 1, 1), "");
    EXPECT_NE(check(left, right, 1e-6, 1), "");
    EXPECT_NE(check({1e6, left.temperature}, right, 1, 1), "");
  }
  EXPECT_EQ(check(cold, {1, 1e147}, 1, 2), "");
  EXPECT_EQ(check(cold, {1, 1e148}, 1, 1), "");
  EXPECT_NE(check(cold, {1, 1e148}, 1, 2).find("the rate of crossings times the square of the temperature"),
            std::string::npos);
}

TEST(Limits, NameTheOptionsThatLeadBeyondThem) {
  const Extent usual{1, 1, 100, 10, 1e10, "--hot", "--until"};
  const auto refused = [](const std::string& beginning, const Extent& extent) {
    return refused_as(beginning, [&] { require_representable(extent); });
  };
  EXPECT_NO_THROW(require_representable(usual));

  Extent extent = usual;
  extent.hottest = 1e301;
  EXPECT_TRUE(refused("--hot: the highest temperature", extent));

  extent = usual;
  extent.cell_length = 1e291;
  EXPECT_TRUE(refused("--cell-length, --hot: the time of a thermal flight", extent));

  extent = usual;
  extent.end_time = 1e-291;
  EXPECT_TRUE(refused("--until: the end of the run", extent));

  extent = usual;
  extent.end_time = 1e10;
  EXPECT_NO_THROW(require_representable(extent));
  extent.end_time = 1.01e10;
  EXPECT_TRUE(refused("--until: the number of thermal flights of one particle", extent));
  extent.hottest = 0.25;  // particles of half the speed
  EXPECT_NO_THROW(require_representable(extent));

  // The sum of all energies is 2e299 * 50 flights * particles.
  extent = {2e299, 2e149, 50 * 2e149 / std::sqrt(2e299), 1e2, 1e10, "--hot", "--until"};
  EXPECT_NO_THROW(require_representable(extent));
  extent.particles = 1e4;
  EXPECT_TRUE(refused("--hot: the sum of all energies seen", extent));
}

TEST(Limits, OfTheSizeOfARecord) {
  EXPECT_NO_THROW(require_record_size(1e8, "--cells"));
  EXPECT_EQ(refusal([] { require_record_size(2e8, "--cells, --bins"); }),
            "--cells, --bins: a replica would keep 2e+08 values, more than 1e8. Choose fewer of either.");
}

// Detected mistake: the product is calculated in 32 bits, where 65536 times 65536 is 0.
TEST(Limits, OfTheNumberOfParticles) {
  const auto check = [](std::uint32_t cells, std::uint32_t particles_per_cell) {
    return refusal([&] {
      require_possible({.cells = cells, .particles_per_cell = particles_per_cell}, 1, 1, 1e10, "--hot",
                       "--until");
    });
  };
  EXPECT_EQ(check(10'000, 100'000), "");
  EXPECT_EQ(check(10'000, 100'001),
            "--cells times --particles-per-cell exceeds 1e9 particles. Choose a smaller chain.");
  EXPECT_NE(check(65'536, 65'536), "");
}

}  // namespace limits_test
