#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "numerics/stream_key.hpp"

namespace lorentz {

/// One replica, as the observable sees it.
struct Replica {
  StreamKey key;  // of all that it draws
  /// To be called often with the part done, in [0, 1]. Throws Interrupted when the run must end.
  std::function<void(double)> heartbeat;
};

/// What a replica measured: sums whose mean over replicas is meaningful, and its number of events.
struct ReplicaRecord {
  std::vector<double> values;
  std::uint64_t events = 0;
};

using Measurement = std::function<ReplicaRecord(const Replica&)>;

/// Finished replicas by index.
using FinishedReplicas = std::map<std::uint64_t, ReplicaRecord>;

struct ReplicaRun {
  std::uint64_t seed;
  std::uint64_t wanted;  // replicas 0 ... wanted - 1
  unsigned threads;
  std::chrono::steady_clock::time_point deadline;  // no replica is begun later, but the first two are

  /// Called by the calling thread a few times per second; replicas in progress count in part.
  std::function<void(double replicas_done, const FinishedReplicas&)> report;
};

/// Measures every replica that is wanted and not yet in `finished`, in the order of the index, each
/// on one thread, and adds it. A replica's record depends on its index alone. Returns when all are
/// finished, or at the deadline when those begun are finished; the finished ones are then those with
/// the lowest indices. Throws Interrupted after a signal, or the first exception of a replica; what
/// was finished before is in `finished`.
void run_replicas(const ReplicaRun& run, const Measurement& measure, FinishedReplicas& finished);

}  // namespace lorentz
