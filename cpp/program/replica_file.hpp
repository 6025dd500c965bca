#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "statistics/tally.hpp"

namespace lorentz {

/// Tallies of a replica, sums whose mean over replicas is meaningful, and its number of events.
struct FinishedReplica {
  std::vector<double> values;
  std::uint64_t events = 0;
};

/// Finished replicas by index.
using FinishedReplicas = std::map<std::uint64_t, FinishedReplica>;

/// Format of files with finished replicas of one run, checkpoints and parts: HDF5, and a checksum of what
/// precedes it.
struct ReplicaFile {
  static constexpr auto part_suffix = ".part";

  std::string identity;  // everything that the tallies depend on: parameters and sources
  std::vector<Description> tallies;

  std::vector<std::byte> content(const FinishedReplicas& finished) const;

  /// None if the file is of other options or another build. Throws UsageError if it cannot be read or is
  /// damaged.
  std::optional<FinishedReplicas> read(const std::string& path) const;

  /// The replicas of all files NAME.part in a folder. Throws UsageError if there is none, or one is damaged
  /// or of another run.
  FinishedReplicas join(const std::string& folder) const;
};

}  // namespace lorentz
