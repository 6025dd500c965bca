#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "numerics/stream_key.hpp"

namespace lorentz {

/// Random streams and heartbeat of one replica, the input of its measurement.
struct Replica {
  StreamKey key;  // of all its random numbers
  /// The measurement calls it often with its completed part in [0, 1]. Throws Interrupted if the run must
  /// end.
  std::function<void(double)> heartbeat;
};

/// Tallies of a replica, sums whose mean over replicas is meaningful, and its number of events.
struct ReplicaRecord {
  std::vector<double> values;
  std::uint64_t events = 0;
};

using Measurement = std::function<ReplicaRecord(const Replica&)>;

/// Finished replicas by index.
using FinishedReplicas = std::map<std::uint64_t, ReplicaRecord>;

/// Number of replicas, resources and reporting of run_replicas().
struct ReplicaRun {
  std::uint64_t seed;
  std::uint64_t first, end;  // replicas first ... end - 1
  unsigned threads;
  std::chrono::steady_clock::time_point deadline;  // no replica but 0 and 1 starts after it

  /// Called in the thread of run_replicas() a few times per second; replicas in progress count as fractions.
  std::function<void(double replicas_done, const FinishedReplicas&)> report;

  /// Called with one line if not all threads could be started.
  std::function<void(const std::string&)> warn;

  /// Called in the thread of run_replicas() if a replica goes on for a second after a signal, as while a
  /// large system is set up. It must save the finished replicas and end the process.
  std::function<void(int signal, const FinishedReplicas&)> abandon;
};

/// Measures every wanted replica that is not in `finished`, in the order of the index, each in one thread,
/// and adds it. The record of a replica depends on its index alone. If the system does not give the threads
/// asked for, those that it gives do the work, or else the calling one. Returns when all are finished, or
/// after the deadline when those in progress are; the finished ones then have the lowest indices. Throws
/// Interrupted after a signal, or the first exception of a replica; `finished` then contains the replicas
/// finished before.
void run_replicas(const ReplicaRun& run, const Measurement& measure, FinishedReplicas& finished);

}  // namespace lorentz
