#pragma once

#include <cstdint>
#include <string>

#include "program/options.hpp"

namespace lorentz {

/// Options that all studies share. Without a target error a run has `replicas` replicas; with one, batches of
/// that size are added until the StoppingRule is met.
struct ReplicaParameters {
  std::uint64_t replicas = 16;
  std::uint64_t max_replicas = 1'000'000;
  std::uint64_t seed = 1;
  std::uint32_t threads = 1;
  double target_error = 0;     // relative; 0: none
  double target_absolute = 0;  // 0: none
  double time_limit = 0;       // seconds; 0: none
  double checkpoint_interval = 60;
  bool resume = false;
  std::string part;  // "first-last" of the replicas to measure apart; empty: all
  std::string join;  // folder with parts; empty: none

  bool has_target() const { return target_error > 0 || target_absolute > 0; }
};

void declare(Options& options, ReplicaParameters& parameters);

/// Throws UsageError if options that are valid one by one exclude each other.
void require_consistent(const ReplicaParameters& parameters, const Options& options,
                        const std::string& output);

}  // namespace lorentz
