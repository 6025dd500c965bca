#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace lorentz {

/// Tallies of a replica, sums whose mean over replicas is meaningful, and its number of events.
struct FinishedReplica {
  std::vector<double> values;
  std::uint64_t events = 0;
};

/// Finished replicas by index.
using FinishedReplicas = std::map<std::uint64_t, FinishedReplica>;

/// The finished replicas of a run in an HDF5 file, with a checksum as that of a result.
struct Checkpoint {
  std::string path;
  std::string identity{};     // of the run, as of its result: options that determine it, and sources
  double former_seconds = 0;  // CPU time of the processes before this one, from load()

  /// At least one replica. Throws UsageError if the file cannot be written.
  void save(const FinishedReplicas& finished) const;

  /// No replicas if the file is of other options or sources. Throws UsageError if it cannot be read or is
  /// damaged.
  FinishedReplicas load();
};

}  // namespace lorentz
