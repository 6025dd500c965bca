#pragma once

#include <Random123/philox.h>

#include <cmath>
#include <cstdint>
#include <numbers>

#include "numerics/stream_key.hpp"

namespace lorentz {

/// Use of a random stream, part of its key. New values are appended, because another value for a use would
/// change the results of every seed.
enum class Purpose : std::uint64_t {
  initial_position = 0,
  initial_particle_momentum = 1,
  initial_scatterer_momentum = 2,
  passes = 3,     // number of cells to the next scattering [eq. 7]
  collision = 4,  // random numbers of a collision rule
  injection_left = 5,
  injection_right = 6,
  initial_chain = 7,   // warm start of an open chain
  initial_number = 8,  // of particles, stationary start of a closed chain
};

/// Counter-based random number generator: Philox4x64-10 with the key (seed, purpose) and the counter (block,
/// entity, replica, 0) (Salmon et al., SC11, doi:10.1145/2063384.2063405). Streams share no state, so results
/// do not depend on the number of threads.
class RandomStream {
 public:
  RandomStream(const StreamKey& key, Purpose purpose, std::uint64_t entity)
      : key_{{key.seed, static_cast<std::uint64_t>(purpose)}}, counter_{{0, entity, key.replica, 0}} {}

  /// Stream of one event, the `event`-th of the entity: counter (event, entity, replica, block). Entities
  /// with many events store only their number, not a generator.
  RandomStream(const StreamKey& key, Purpose purpose, std::uint64_t entity, std::uint64_t event)
      : key_{{key.seed, static_cast<std::uint64_t>(purpose)}},
        counter_{{event, entity, key.replica, 0}},
        block_number_(3) {}

  /// Uniform on the open interval (0, 1). The upper 52 bits of a word give an odd multiple of 2^-53, so 0 and
  /// 1 do not occur.
  double uniform() { return unit_interval(next()); }

  static double unit_interval(std::uint64_t word) {
    return (static_cast<double>(word >> 12) + 0.5) * 0x1p-52;
  }

  /// Exponential, pdf exp(-x) for x > 0, by inversion of a uniform number. The largest value is 53 ln 2 =
  /// 36.7.
  double exponential() { return -std::log(uniform()); }

  /// Standard normal, pdf exp(-x^2/2)/sqrt(2 pi), by the Box-Muller transform (Ann. Math. Stat. 29, 610
  /// (1958)) of two uniform numbers, of which only the cosine is used. The largest modulus is sqrt(106 ln 2)
  /// = 8.6.
  double gaussian() {
    const double radius = std::sqrt(-2 * std::log(uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }

 private:
  std::uint64_t next() {
    if (used_ == 4) {
      block_ = r123::Philox4x64()(counter_, key_);
      ++counter_[block_number_];
      used_ = 0;
    }
    return block_[used_++];
  }

  r123::Philox4x64::key_type key_;
  r123::Philox4x64::ctr_type counter_;
  r123::Philox4x64::ctr_type block_{};
  unsigned used_ = 4, block_number_ = 0;  // words used of the block; which counter counts the blocks
};

}  // namespace lorentz
