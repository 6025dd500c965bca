#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "numerics/stream_key.hpp"
#include "program/program.hpp"
#include "program/replica_file.hpp"
#include "statistics/group.hpp"
#include "statistics/tally.hpp"

namespace lorentz {

/// Random streams and heartbeat of one replica, the input of its simulation.
struct Replica {
  StreamKey key;  // of all its random numbers
  /// The simulation calls it often with its completed part in [0, 1]. Throws if the run must end.
  std::function<void(double)> heartbeat;
};

/// Measurement over independent replicas: the tallies of a replica and the quantities estimated from them.
struct Study {
  TallySchema tallies;
  std::function<std::uint64_t(const Replica&, TallySums&)> sample;  // of one replica; returns its events
  std::vector<Group> groups;
  std::string target;  // quantity of --target-error
};

/// An executable that runs a study: measures replicas in threads until their number or the target error is
/// reached, or a part of the replicas, with checkpoints, resumption and time limit. The tallies of a replica
/// depend on its index alone, so results do not depend on threads and interruptions.
class StudyProgram {
 public:
  StudyProgram(const std::string& name, const std::string& description);

  Options& options() { return program_.options(); }

  /// `make` gives the study of the parsed options. It throws UsageError if options that are valid one by one
  /// exclude each other. Returns the exit status.
  int run(int argc, char** argv, const std::function<Study()>& make);

 private:
  void require_consistent();
  std::vector<Description> quantities() const;
  void prepare();
  ExitStatus compute();
  void run_replicas(std::uint64_t first, std::uint64_t end);
  void work(std::uint64_t end);
  void report();
  Outcome estimate(std::uint64_t wanted) const;
  bool save(const std::string& prefix);
  void keep(const std::string& why);
  double target() const { return target_error_ > 0 ? target_error_ : target_absolute_; }  // 0: none

  Program program_;

  // Options. Without a target error a run has `replicas_` replicas; with one, batches of that size are added
  // until the StoppingRule is met.
  static constexpr std::uint64_t most_replicas = 1'000'000;  // with a target error, but at least one batch
  std::uint64_t replicas_ = 16, seed_ = 1;
  std::uint32_t threads_ = 1;
  double target_error_ = 0, target_absolute_ = 0;  // 0: none
  double time_limit_ = 0;                          // seconds; 0: none
  double checkpoint_interval_ = 60;
  bool resume_ = false;
  std::string part_;  // "first-last" of the replicas to measure apart; empty: all
  std::uint64_t part_first_ = 0, part_last_ = 0;
  std::string join_;  // folder with parts; empty: none

  Study study_;
  ReplicaFile format_{};
  std::string checkpoint_;      // path
  double next_checkpoint_ = 0;  // as elapsed()
  std::size_t resumed_ = 0;     // replicas from files
  std::uint64_t needed_ = 0;    // predicted number of replicas in all
  bool warned_ = false;         // of a checkpoint that cannot be written

  // Shared by the threads under the mutex.
  std::mutex mutex_;
  std::condition_variable changed_;
  FinishedReplicas finished_;
  std::uint64_t next_ = 0;  // replica that starts next
  std::size_t active_ = 0;  // threads
  std::exception_ptr failure_;
  std::atomic<bool> failed_{false};
  std::atomic<double> in_progress_{0};  // sum of the completed parts of unfinished replicas
};

}  // namespace lorentz
