#include "program/replica_parameters.hpp"

#include <fmt/format.h>

#include "program/errors.hpp"
#include "program/parts.hpp"
#include "program/stopping_rule.hpp"

namespace lorentz {
namespace {

void require_part(const ReplicaParameters& parameters, const std::string& output) {
  Part::from(parameters.part, parameters.replicas);
  if (parameters.has_target() || parameters.time_limit > 0 || !parameters.join.empty())
    throw UsageError(
        "--part is given with a target error, a time limit or --join: a part is so many replicas, neither "
        "more "
        "nor fewer. Leave out one of the two.");
  if (!output.ends_with(Part::suffix))
    throw UsageError(fmt::format("--part writes records, not results. Let --output '{}' end with {}.", output,
                                 Part::suffix));
}

}  // namespace

void declare(Options& options, ReplicaParameters& parameters) {
  constexpr auto runtime = Options::Role::runtime;
  options.integer("--replicas", parameters.replicas, {1, 100'000'000},
                  "Independent replicas; with a target error, replicas per batch");
  options.integer("--max-replicas", parameters.max_replicas, {1, 100'000'000},
                  "Largest number of replicas with a target error");
  options.integer("--seed", parameters.seed, {}, "Key of all random streams");
  options.real("--target-error", parameters.target_error, non_negative, "1",
               fmt::format("Add replicas, {} at least, until the relative standard error of the target "
                           "quantity is below this with 95 % confidence; 0: no target",
                           StoppingRule::least));
  options.real("--target-absolute", parameters.target_absolute, non_negative, "that of the target quantity",
               "The same for the standard error itself; 0: no target");
  options.integer("--threads", parameters.threads, {1, 4096}, "Threads; no result depends on them", runtime);
  options.real(
      "--time-limit", parameters.time_limit, non_negative, "s",
      "Seconds after which no replica but the first two starts; those in progress are finished; 0: none",
      runtime);
  options.real("--checkpoint-interval", parameters.checkpoint_interval, positive, "s",
               "Seconds between checkpoints in OUTPUT.checkpoint", runtime);
  options.flag("--resume", parameters.resume, "Resume from OUTPUT.checkpoint if it exists", runtime);
  options.text(
      "--part", parameters.part,
      "Measure only these replicas, as 24-47, and write their records, to be joined; OUTPUT ends with "
      ".part",
      runtime);
  options.text("--join", parameters.join,
               "Take over what the parts in this folder have measured, and measure the rest", runtime);
}

void require_consistent(const ReplicaParameters& parameters, const Options& options,
                        const std::string& output) {
  if (parameters.target_error > 0 && parameters.target_absolute > 0)
    throw UsageError(
        "--target-error and --target-absolute are both given: a run has one target. Leave out one of the "
        "two.");
  if ((parameters.has_target() || options.given("--max-replicas")) &&
      parameters.max_replicas < parameters.replicas)
    throw UsageError(fmt::format(
        "--max-replicas {} is below --replicas {}: not even one batch would be allowed. Choose a smaller "
        "batch or a larger maximum.",
        parameters.max_replicas, parameters.replicas));
  if (!parameters.part.empty()) require_part(parameters, output);
}

}  // namespace lorentz
