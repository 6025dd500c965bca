#pragma once

#include <bit>
#include <cstdint>

namespace lorentz {

/// 1 to the right, -1 to the left. By the bit of the sign, as compilers make a branch of a comparison, and
/// the direction after a collision cannot be predicted.
inline std::int64_t direction(double u) { return 1 | (std::bit_cast<std::int64_t>(u) >> 63); }

/// One particle on its way to a scatterer: its only pending event. Aligned so that none lies across two lines
/// of the cache.
struct alignas(32) Flight {
  double time;              // of arrival
  double velocity;          // u
  std::uint32_t target;     // scatterer
  std::uint32_t particle;   // its number
  std::uint64_t draws = 0;  // random numbers that the particle has taken, see Launch
};

}  // namespace lorentz
