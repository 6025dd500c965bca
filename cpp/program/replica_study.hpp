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

/// Options that every replicated program shares, and the run itself: batches of replicas until the
/// target error is reached, checkpoints, resumption, time limit.
///
/// Without a target one batch of --replicas is measured. With one, batches are added until the StoppingRule
/// is content.
class ReplicaOptions {
 public:
  explicit ReplicaOptions(const Program& program);

  void declare(Options& options);

  /// Throws UsageError, NumericalError or Interrupted.
  Outcome run(const ReplicaStudy& study, Progress& progress) const;

 private:
  const Program& program_;
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
