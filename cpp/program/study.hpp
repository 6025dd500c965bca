#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "numerics/stream_key.hpp"
#include "program/checkpoint.hpp"
#include "program/program.hpp"
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
  std::string target;  // quantity of --target-error; of an array, its least accurate element
  /// Lines to print after the results: what restricts their meaning, and what to do. None if empty.
  std::function<std::vector<std::string>(const Results&)> remarks{};
};

/// An executable that runs a study: measures replicas in threads until their number or the target error is
/// reached, with checkpoints and resumption. The tallies of a replica depend on its index alone, so results
/// do not depend on threads and interruptions.
class StudyProgram {
 public:
  StudyProgram(const std::string& name, const std::string& description);

  Options& options() { return program_.options(); }

  /// `make` gives the study of the parsed options. It throws UsageError if options that are valid one by one
  /// exclude each other. Returns the exit status.
  int run(int argc, char** argv, const std::function<Study()>& make);

 private:
  std::vector<Description> quantities() const;
  const Group& group_of(const std::string& name) const;
  void require_memory() const;
  void prepare();
  ExitStatus compute();
  void in_threads(std::uint64_t number, const std::function<void()>& task);
  void measure(std::uint64_t end);
  void show_progress();
  bool save(const std::string& prefix);
  void checkpoint_on_exit(const std::string& why);
  RunResult estimate(std::uint64_t replicas) const;
  void report(const RunResult& result, std::uint64_t replicas);

  Program program_;

  // Options. A run has `replicas_` replicas or, with a target error, as many as the StoppingRule needs.
  std::uint64_t replicas_ = 32, seed_{};
  std::optional<std::uint32_t> threads_{};  // none: one for each processor
  double target_error_ = 0;                 // 0: none
  double target_scale_ = 0;                 // 0: the target quantity's mean
  double checkpoint_interval_ = 60;
  bool resume_ = false;

  Study study_;
  Checkpoint checkpoint_;
  double next_checkpoint_ = 0;  // as elapsed()
  std::size_t resumed_ = 0;     // replicas from the checkpoint
  std::uint64_t needed_ = 0;    // predicted number of replicas in all
  bool warned_ = false;         // of a checkpoint that cannot be written

  // Shared by the threads under the mutex.
  std::mutex mutex_;
  FinishedReplicas finished_;
  std::uint64_t next_ = 0;  // replica that starts next
  double in_progress_ = 0;  // sum of the completed parts of unfinished replicas
  std::atomic<bool> failed_{false};
};

}  // namespace lorentz
