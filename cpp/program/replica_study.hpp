#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "program/program.hpp"
#include "program/replicas.hpp"
#include "statistics/records.hpp"

namespace lorentz {

/// A measurement over independent replicas: what one replica records, and what the records say.
struct ReplicaStudy {
  Measurement measure;
  std::function<Results(const Records&)> summarise;
  std::string target_quantity;  // name of the number that --target-error speaks of
  std::string streams;          // of random numbers, for the record
};

/// Replicas that a target error needs, whole batches of them, if errors fall as one over the square root of
/// their number; excess is the error of those used over the target. At least one batch more, and no more than
/// `most`; one batch more if there is no error to go by.
std::uint64_t replicas_needed(std::uint64_t used, double excess, std::uint64_t batch, std::uint64_t most);

/// Replicas at which the error is looked at next: a batch more, later an eighth more in whole batches, as the
/// jackknife takes a time in proportion to what there is; no more than `most`, unless one batch is more.
std::uint64_t next_look(std::uint64_t used, std::uint64_t batch, std::uint64_t most);

/// Options that every replicated program shares, and the run itself: batches of replicas until the
/// target error is reached, checkpoints, resumption, time limit.
///
/// Without a target one batch of --replicas is measured. With one, batches are added, and the error
/// is looked at at given numbers of them only, so that the result depends neither on the number of threads
/// nor on interruptions.
class ReplicaOptions {
 public:
  explicit ReplicaOptions(Program& program);

  /// Throws UsageError, NumericalError or Interrupted.
  Outcome run(const ReplicaStudy& study, Progress& progress) const;

 private:
  Program& program_;
  std::uint64_t replicas_ = 16;
  std::uint64_t max_replicas_ = 1'000'000;
  std::uint64_t seed_ = 1;
  std::uint32_t threads_;
  double target_error_ = 0;
  double target_absolute_ = 0;
  double time_limit_ = 0;
  double checkpoint_interval_ = 60;
  bool resume_ = false;
};

}  // namespace lorentz
