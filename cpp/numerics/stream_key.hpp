#pragma once

#include <cstdint>

namespace lorentz {

/// Identity of the random streams of one replica. Whatever draws takes one; there is no default, because
/// replicas that share a stream are not independent, and no error bar shows it.
struct StreamKey {
  std::uint64_t seed, replica;

  StreamKey(std::uint64_t seed_of_run, std::uint64_t replica_of_run)
      : seed(seed_of_run), replica(replica_of_run) {}
};

}  // namespace lorentz
