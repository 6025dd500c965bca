#include "program/replica_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

#include "program/build_info.hpp"
#include "program/checkpoint.hpp"
#include "program/errors.hpp"
#include "program/stopping_rule.hpp"

namespace lorentz {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

Clock::time_point later(double seconds) {
  constexpr double for_ever = 1e9;  // longer than any run, and far from the end of the clock
  if (seconds > for_ever) return Clock::time_point::max();
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(Seconds(seconds));
}

/// The first replicas, up to the first that is missing and no more than wanted. A resumed run may have
/// others: of later batches, or finished out of order.
FinishedReplicas first_of(const FinishedReplicas& finished, std::uint64_t wanted) {
  FinishedReplicas first;
  for (const auto& [index, record] : finished) {
    if (index != first.size() || index == wanted) break;
    first.emplace(index, record);
  }
  return first;
}

Records as_records(const FinishedReplicas& finished) {
  Records records(finished.begin()->second.values.size());
  for (const auto& [index, record] : finished) records.append(record.values);
  return records;
}

const Quantity& quantity_named(const Results& results, const std::string& name) {
  const auto found = std::find_if(results.begin(), results.end(),
                                  [&](const Quantity& quantity) { return quantity.what.name == name; });
  if (found == results.end()) throw std::logic_error("no quantity named " + name);
  return *found;
}

/// Standard error of a number, relative to it unless `absolute`. An error of exactly 0 is 0 either way.
double error_of(const Quantity& target, bool absolute) {
  const double error = target.standard_error.front();
  return absolute || error == 0 ? error : error / std::abs(target.mean.front());
}

Convergence convergence_of(bool complete, bool has_target, bool reached) {
  if (!complete) return Convergence::not_reached;
  if (!has_target) return Convergence::no_target;
  return reached ? Convergence::reached : Convergence::not_reached;
}

/// Of normal records; more where they are skewed.
void warn_of_few(std::size_t replicas, Progress& progress) {
  constexpr std::size_t enough = 32;
  if (replicas > 1 && replicas < enough)
    progress.say(fmt::format("standard errors from {} replicas are uncertain by about {:.0f} %", replicas,
                             100 / std::sqrt(2.0 * static_cast<double>(replicas - 1))));
}

}  // namespace

ReplicaOptions::ReplicaOptions(const Program& program)
    : program_(program), threads_(std::max(1U, std::thread::hardware_concurrency())) {}

void ReplicaOptions::declare(Options& options) {
  constexpr auto conduct = Options::Role::conduct;
  options.integer("--replicas", replicas_, {1, 100'000'000},
                  "Independent replicas; with a target error, replicas per batch");
  options.integer("--max-replicas", max_replicas_, {1, 100'000'000},
                  "With a target error, give up after so many");
  options.integer("--seed", seed_, {}, "Key of all random streams");
  options.real(
      "--target-error", target_error_, non_negative,
      fmt::format("Add replicas, {} at least, until the relative standard error of the target quantity is "
                  "below this with 95 % confidence; 0: no target",
                  StoppingRule::least));
  options.real("--target-absolute", target_absolute_, non_negative,
               "The same for the standard error itself; 0: no target");
  options.integer("--threads", threads_, {1, 4096}, "Threads; no result depends on them", conduct);
  options.real(
      "--time-limit", time_limit_, non_negative,
      "Seconds after which no replica is begun (the first two always are); those begun are finished; 0: none",
      conduct);
  options.real("--checkpoint-interval", checkpoint_interval_, positive,
               "Seconds between checkpoints in OUTPUT.checkpoint", conduct);
  options.flag("--resume", resume_, "Go on from OUTPUT.checkpoint if it is there", conduct);
}

Outcome ReplicaOptions::run(const ReplicaStudy& study, Progress& progress) const {
  if (target_error_ > 0 && target_absolute_ > 0)
    throw UsageError("--target-error and --target-absolute exclude each other: give one.");
  const bool absolute = target_absolute_ > 0;
  const double target = absolute ? target_absolute_ : target_error_;
  const Clock::time_point deadline = time_limit_ > 0 ? later(time_limit_) : Clock::time_point::max();

  const Checkpoint checkpoint(
      program_.output(),
      fmt::format("{}build_id = {}\n", as_text(program_.options().parameters()), build_info.build_id));
  FinishedReplicas finished;
  if (resume_) finished = checkpoint.load();
  const auto resumed = static_cast<double>(finished.size());
  Clock::time_point next_checkpoint = later(checkpoint_interval_);

  const StoppingRule rule{.batch = replicas_, .most = max_replicas_};
  ReplicaRun batch{.seed = seed_,
                   .wanted = target > 0 ? rule.next_look(0) : replicas_,
                   .threads = threads_,
                   .deadline = deadline,
                   .report = {}};
  std::uint64_t needed = batch.wanted;  // in all, as far as it can be told
  batch.report = [&](double done, const FinishedReplicas& so_far) {
    progress.show(done, static_cast<double>(needed), resumed);
    if (Clock::now() < next_checkpoint) return;
    checkpoint.save(so_far);
    next_checkpoint = later(checkpoint_interval_);
  };

  Outcome outcome{.seed = seed_, .streams = study.streams, .target_quantity = study.target_quantity};
  outcome.target_error = target > 0 ? target : std::numeric_limits<double>::quiet_NaN();
  for (;; batch.wanted = rule.next_look(batch.wanted)) {
    try {
      run_replicas(batch, study.measure, finished);
    } catch (const Interrupted& interruption) {
      checkpoint.save(finished);
      progress.say(fmt::format("interrupted after {} replicas; --resume goes on from '{}'", finished.size(),
                               checkpoint.path()));
      throw;
    }
    const FinishedReplicas used = first_of(finished, batch.wanted);
    outcome.events = 0;
    for (const auto& [index, record] : used) outcome.events += record.events;
    outcome.results = study.summarise(as_records(used));
    const Quantity& quantity = quantity_named(outcome.results, study.target_quantity);
    outcome.achieved_error = error_of(quantity, absolute);
    const bool out_of_time = used.size() < batch.wanted;
    const double excess = outcome.achieved_error / target;
    outcome.convergence = convergence_of(!out_of_time && std::isfinite(quantity.mean.front()), target > 0,
                                         StoppingRule::reached(used.size(), excess));
    const bool not_reached = outcome.convergence == Convergence::not_reached;
    const bool last = !not_reached || out_of_time || target == 0 || batch.wanted + replicas_ > max_replicas_;
    std::string forecast;
    if (!last && std::isfinite(excess)) {
      const StoppingRule::Forecast end = rule.forecast(used.size(), excess);
      needed = end.likely;
      forecast = fmt::format("; the run ends after {} to {}", end.low, end.high);
    }
    progress.say(fmt::format("{} replicas: {} = {:.8g} +- {:.2g}{}{}", used.size(), quantity.what.name,
                             quantity.mean.front(), quantity.standard_error.front(),
                             not_reached ? ", not reached" : "", forecast));
    if (!last) continue;
    warn_of_few(used.size(), progress);
    break;
  }
  checkpoint.remove();
  return outcome;
}

}  // namespace lorentz
