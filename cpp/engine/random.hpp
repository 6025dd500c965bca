#pragma once

#include <Random123/philox.h>

#include <cmath>
#include <cstdint>
#include <numbers>

#include "model/portable.hpp"
#include "numerics/stream_key.hpp"

namespace lorentz {

/// What a stream of random numbers is for. Append only: a value in use never changes its meaning.
enum class Purpose : std::uint64_t {
  initial_position = 0,
  initial_particle_momentum = 1,
  initial_scatterer_momentum = 2,
  passes = 3,     // scatterers passed without scattering
  direction = 4,  // after a collision, where it is drawn
  injection_left = 5,
  injection_right = 6,
  initial_chain = 7,  // everything in the warm start of an open chain
};

/// Counter-based stream: Philox4x64-10 keyed by (seed, purpose), counted by (block, entity,
/// replica). Streams need no shared state, so results do not depend on the number of threads.
/// (Salmon et al., SC11, doi:10.1145/2063384.2063405)
class RandomStream {
 public:
  static constexpr const char* description =
      "Philox4x64-10; key (seed, purpose); counter (block, entity, replica, 0)";

  RandomStream(const StreamKey& key, Purpose purpose, std::uint64_t entity)
      : key_{{key.seed, static_cast<std::uint64_t>(purpose)}}, counter_{{0, entity, key.replica, 0}} {}

  /// Uniform in the open interval (0, 1), an odd multiple of 2^-53.
  double uniform() { return unit_interval(next()); }

  static double unit_interval(std::uint64_t word) {
    return (static_cast<double>(word >> 12) + 0.5) * 0x1p-52;
  }

  /// Exponential with mean 1.
  double exponential() { return -portable::log(uniform()); }

  /// Standard normal, by the Box-Muller transform; two words per number.
  double gaussian() {
    const double radius = std::sqrt(-2 * portable::log(uniform()));
    return radius * portable::cos(2 * std::numbers::pi * uniform());
  }

 private:
  std::uint64_t next() {
    if (used_ == 4) {
      block_ = r123::Philox4x64()(counter_, key_);
      ++counter_[0];
      used_ = 0;
    }
    return block_[used_++];
  }

  r123::Philox4x64::key_type key_;
  r123::Philox4x64::ctr_type counter_;
  r123::Philox4x64::ctr_type block_{};
  unsigned used_ = 4;
};

/// One number by its place, the first of block `draw` of the stream of (key, purpose, entity):
/// for entities that draw one number now and then.
inline double uniform(const StreamKey& key, Purpose purpose, std::uint64_t entity, std::uint64_t draw) {
  const r123::Philox4x64::key_type philox_key{{key.seed, static_cast<std::uint64_t>(purpose)}};
  return RandomStream::unit_interval(r123::Philox4x64()({{draw, entity, key.replica, 0}}, philox_key)[0]);
}

}  // namespace lorentz
