#pragma once

#include <cstdint>

namespace lorentz {

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
