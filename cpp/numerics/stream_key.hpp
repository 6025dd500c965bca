#pragma once

#include <cstdint>

namespace lorentz {

/// Key of the random streams of one replica, an argument of every function that draws random numbers. It has
/// no default, because replicas that share a stream are not independent, and their standard error does not
/// show this.
struct StreamKey {
  std::uint64_t seed, replica;

  StreamKey(std::uint64_t seed_of_run, std::uint64_t replica_of_run)
      : seed(seed_of_run), replica(replica_of_run) {}
};

}  // namespace lorentz
