#include "program/study.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

#include "numerics/random.hpp"
#include "program/atomic_file.hpp"
#include "program/build_info.hpp"
#include "program/errors.hpp"
#include "program/missing_in_libcxx.hpp"
#include "program/stopping_rule.hpp"

namespace lorentz {
namespace {

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): a signal handler reaches nothing else
std::atomic<int> received_signal{0};
static_assert(std::atomic<int>::is_always_lock_free, "signal handlers may only access lock-free atomics");

/// Records SIGINT, SIGTERM, SIGHUP and SIGXCPU from now on; a file that is being written is written to its
/// end. SIGHUP remains ignored where it is, as by nohup.
void note_signals() {
  const auto note = [](int number) { received_signal.store(number); };
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGXCPU})
    if (::signal(number, note) == SIG_IGN && number == SIGHUP) ::signal(number, SIG_IGN);
}

}  // namespace

StudyProgram::StudyProgram(const std::string& name, const std::string& description)
    : program_(name, description), threads_(std::max(1U, std::thread::hardware_concurrency())) {}

int StudyProgram::run(int argc, char** argv, const std::function<Study()>& make) {
  Options& options = this->options();
  constexpr auto runtime = Options::Role::runtime;
  options.integer("--replicas", replicas_, {1, 100'000'000},
                  "Independent replicas; with a target error, replicas per batch");
  options.integer("--seed", seed_, {}, "Key of all random streams");
  options.real("--target-error", target_error_, non_negative, "1",
               fmt::format("Add replicas, {} at least, until the relative standard error of the target "
                           "quantity is below this with 95 % confidence; 0: no target",
                           StoppingRule::least));
  options.real("--target-absolute", target_absolute_, non_negative, "that of the target quantity",
               "The same for the standard error itself; 0: no target");
  options.integer("--threads", threads_, {1, 4096}, "Threads; no result depends on them", runtime);
  options.real(
      "--time-limit", time_limit_, non_negative, "s",
      "Seconds after which no replica but the first two starts; those in progress are finished; 0: none",
      runtime);
  options.real("--checkpoint-interval", checkpoint_interval_, positive, "s",
               "Seconds between checkpoints in OUTPUT.checkpoint", runtime);
  options.flag("--resume", resume_, "Resume from OUTPUT.checkpoint if it exists", runtime);
  options.text(
      "--part", part_,
      "Measure only these replicas, as 24-47, and write their records, to be joined; OUTPUT ends with .part",
      runtime);
  options.text("--join", join_, "Take over what the parts in this folder have measured, and measure the rest",
               runtime);
  const auto plan = [&] {
    require_consistent();
    study_ = make();
    return quantities();
  };
  return program_.run(argc, argv, plan, [this] { return compute(); });
}

std::vector<Description> StudyProgram::quantities() const {
  std::vector<Description> all;
  for (const Group& group : study_.groups)
    for (Description& what : group.descriptions()) all.push_back(std::move(what));
  if (std::ranges::find(all, study_.target, &Description::name) == all.end())
    throw std::logic_error("the study has no quantity named as its target, " + study_.target);
  return all;
}

/// Reads --part. Throws UsageError if options that are valid one by one exclude each other.
void StudyProgram::require_consistent() {
  if (target_error_ > 0 && target_absolute_ > 0)
    throw UsageError(
        "--target-error and --target-absolute are both given: a run has one target. Leave out one of the "
        "two.");
  if (part_.empty()) return;
  if (target() > 0 || time_limit_ > 0 || !join_.empty())
    throw UsageError(
        "--part is given with a target error, a time limit or --join: a part has a fixed number of replicas. "
        "Leave out one of the two.");
  std::istringstream range(part_);
  char dash = 0;
  if (!(range >> part_first_ >> dash >> part_last_) || dash != '-' || !range.eof() ||
      part_first_ > part_last_ || part_last_ >= replicas_)
    throw UsageError(fmt::format(
        "--part {} is not a range of replicas. Give the first and the last, as 0-{}, of a run that has {}.",
        part_, replicas_ - 1, replicas_));
  if (!program_.output().ends_with(ReplicaFile::part_suffix))
    throw UsageError(fmt::format("--part writes records, not results. The --output '{}' must end with {}.",
                                 program_.output(), ReplicaFile::part_suffix));
}

/// Loads the replicas of the checkpoint and of the parts. Throws UsageError if there is a checkpoint that
/// neither --resume nor --overwrite refers to.
void StudyProgram::prepare() {
  for (const Parameter& each : options().parameters())
    format_.identity += fmt::format("{} = {}\n", each.name, as_text(each.value));
  format_.identity += fmt::format("source_hash = {}\n", build_info.source_hash);
  format_.tallies = study_.tallies.tallies();
  checkpoint_ = program_.output() + ".checkpoint";
  const bool overwrite = options().given("--overwrite");
  if (std::error_code unknown;
      (resume_ || !overwrite) && std::filesystem::is_regular_file(checkpoint_, unknown)) {
    std::optional<FinishedReplicas> saved = format_.read(checkpoint_);
    if (!saved && !overwrite)
      throw UsageError(fmt::format(
          "'{}' is of other options or another build. Choose another --output, or discard it with "
          "--overwrite.",
          checkpoint_));
    if (saved && !resume_)
      throw UsageError(
          fmt::format("'{}' has {} replicas of this run. Continue with --resume, or discard them with "
                      "--overwrite.",
                      checkpoint_, saved->size()));
    if (saved) finished_ = std::move(*saved);
  }
  if (!join_.empty()) finished_.merge(format_.join(join_));
  if (!part_.empty() && !overwrite && std::filesystem::exists(program_.output())) {
    const std::optional<FinishedReplicas> former = format_.read(program_.output());
    if (!former || former->begin()->first != part_first_ || former->rbegin()->first != part_last_)
      throw UsageError(fmt::format(
          "'{}' exists and is of other options, another build or other replicas. Choose another --output, or "
          "replace it with --overwrite.",
          program_.output()));
  }
  resumed_ = finished_.size();
  next_checkpoint_ = program_.elapsed() + checkpoint_interval_;
  note_signals();
}

/// A part at once, a run batch by batch until the last.
ExitStatus StudyProgram::compute() try {
  prepare();
  if (!part_.empty()) {
    needed_ = part_last_ - part_first_ + 1;
    run_replicas(part_first_, part_last_ + 1);
    program_.progress().say(fmt::format("replicas {} are measured, for --join", part_));
    std::uint64_t events = 0;
    for (const auto& [index, replica] : finished_) events += replica.events;
    program_.write(format_.content(finished_), events);
    ::unlink(checkpoint_.c_str());
    return ExitStatus::done;
  }
  const StoppingRule rule{.batch = replicas_, .most = most_replicas};
  needed_ = target() > 0 ? rule.next_look(0) : replicas_;
  for (std::uint64_t wanted = needed_;; wanted = rule.next_look(wanted)) {
    run_replicas(0, wanted);
    Outcome outcome;
    in_threads(1, [&] { outcome = estimate(wanted); });
    const double excess = outcome.achieved_error / target();
    const bool not_reached = outcome.convergence == Convergence::not_reached;
    const bool last =
        !not_reached || outcome.replicas < wanted || target() == 0 || wanted + replicas_ > most_replicas;
    std::string forecast;
    if (!last && std::isfinite(excess)) {
      const StoppingRule::Forecast end = rule.forecast(outcome.replicas, excess);
      needed_ = end.likely;
      forecast = fmt::format("; the run ends after {} to {}", end.low, end.high);
    }
    const Quantity& quantity = quantity_named(outcome.results, study_.target);
    program_.progress().say(fmt::format("{} replicas: {} = {}{}{}", outcome.replicas, study_.target,
                                        with_error(quantity.mean.front(), quantity.standard_error.front()),
                                        not_reached ? ", not reached" : "", forecast));
    if (!last) continue;
    // Errors are uncertain by 1/sqrt(2(R-1)) for normal records, and more for skewed ones.
    constexpr std::size_t enough = 32;
    if (outcome.replicas > 1 && outcome.replicas < enough)
      program_.progress().say(fmt::format("standard errors from {} replicas are uncertain by about {:.0f} %",
                                          outcome.replicas,
                                          100 / std::sqrt(2.0 * static_cast<double>(outcome.replicas - 1))));
    if (study_.remarks)
      for (const std::string& remark : study_.remarks(outcome.results)) program_.progress().say(remark);
    const ExitStatus status = program_.write(outcome);
    ::unlink(checkpoint_.c_str());
    return status;
  }
} catch (...) {
  if (!finished_.empty()) keep("stopped");
  throw;
}

/// Writes a checkpoint; if that fails, warns and returns false.
bool StudyProgram::save(const std::string& prefix) try {
  write_atomically(checkpoint_, format_.content(finished_));
  return true;
} catch (const UsageError& error) {
  program_.progress().warn(prefix + error.what());
  return false;
}

/// Saves the replicas when the run ends early, and reports why it ends and how to resume.
void StudyProgram::keep(const std::string& why) {
  const std::string state = fmt::format("{} after {} replicas", why, finished_.size());
  if (finished_.empty()) return program_.progress().say(state);
  if (save(state + ", which are not saved: "))
    program_.progress().say(fmt::format("{}; --resume continues from '{}'", state, checkpoint_));
}

/// Performs a task in each of some threads, which do not change the finished replicas without the mutex.
/// Meanwhile reports progress and writes checkpoints. After a signal the process ends at once, with a
/// checkpoint. Throws the first exception of a task.
void StudyProgram::in_threads(std::uint64_t number, const std::function<void()>& task) {
  active_ = number;
  const auto perform = [&] {
    try {
      task();
    } catch (...) {
      const std::scoped_lock lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
      failed_ = true;  // every replica stops at its next heartbeat
    }
    const std::scoped_lock lock(mutex_);
    --active_;
    changed_.notify_one();
  };
  std::vector<JoiningThread> threads;
  std::unique_lock lock(mutex_);  // released, so that no thread waits for it, before they are joined
  try {
    while (threads.size() < number) threads.emplace_back(perform);
  } catch (const std::system_error& error) {
    failed_ = true;
    throw UsageError(fmt::format("--threads {}: the system starts only {}: {}. Choose fewer.", threads_,
                                 threads.size(), error.code().message()));
  }
  const auto finished = [this] { return active_ == 0; };
  while (!changed_.wait_for(lock, std::chrono::milliseconds(100), finished) && received_signal == 0) report();
  if (received_signal != 0) {
    keep("interrupted");
    std::_Exit(static_cast<int>(ExitStatus::interrupted) + received_signal);
  }
  if (failure_) std::rethrow_exception(failure_);
}

/// Measures the replicas first ... end - 1 but those that are finished, in the order of the index, each in
/// one thread. Returns when all are finished, or after the time limit when those in progress are; the
/// finished ones then have the lowest indices.
void StudyProgram::run_replicas(std::uint64_t first, std::uint64_t end) {
  next_ = first;
  in_threads(std::min<std::uint64_t>(threads_, end - first), [this, end] { work(end); });
}

/// Takes replicas until there is none, after a failure, and after the time limit except for the first two.
void StudyProgram::work(std::uint64_t end) {
  double completed = 0;
  const auto heartbeat = [&](double part) {
    add(in_progress_, part - std::exchange(completed, part));
    if (failed_) throw std::runtime_error("another replica failed");
  };
  std::unique_lock lock(mutex_);
  for (;;) {
    while (finished_.contains(next_)) ++next_;
    const bool too_late = time_limit_ > 0 && program_.elapsed() >= time_limit_ && next_ >= 2;
    if (next_ >= end || failed_ || too_late) break;
    const std::uint64_t index = next_++;
    lock.unlock();
    TallySums sums(study_.tallies);
    const std::uint64_t events = study_.sample({StreamKey(seed_, index), heartbeat}, sums);
    sums.require_filled(study_.tallies);
    lock.lock();
    finished_.emplace(index, FinishedReplica{sums.values(), events});
    add(in_progress_, -std::exchange(completed, 0));
  }
}

/// The caller holds the mutex.
void StudyProgram::report() {
  program_.progress().show(static_cast<double>(finished_.size()) + in_progress_, static_cast<double>(needed_),
                           static_cast<double>(resumed_));
  if (warned_ || finished_.empty() || program_.elapsed() < next_checkpoint_) return;
  warned_ = !save("the run goes on without a checkpoint: ");  // the results matter more
  next_checkpoint_ = program_.elapsed() + checkpoint_interval_;
}

/// From the replicas 0, 1, ... up to the first one missing, at most `wanted`. A resumed run may have others,
/// of later batches or finished out of order.
Outcome StudyProgram::estimate(std::uint64_t wanted) const {
  Outcome outcome{.seed = seed_,
                  .streams = RandomStream::description,
                  .target_quantity = study_.target,
                  .target_error = target() > 0 ? target() : std::numeric_limits<double>::quiet_NaN()};
  Records records(study_.tallies.width());
  for (const auto& [index, replica] : finished_) {
    if (index != records.size() || index == wanted) break;
    records.append(replica.values);
    outcome.events += replica.events;
  }
  outcome.replicas = records.size();
  for (const Group& group : study_.groups)
    for (Quantity& quantity : group.estimate(records)) outcome.results.push_back(std::move(quantity));
  const Quantity& quantity = quantity_named(outcome.results, study_.target);
  const double mean = quantity.mean.front(), error = quantity.standard_error.front();
  outcome.achieved_error = target_absolute_ > 0 || error == 0 ? error : error / std::abs(mean);
  const bool complete = outcome.replicas == wanted && std::isfinite(mean);
  if (complete && target() == 0) outcome.convergence = Convergence::no_target;
  if (complete && target() > 0 && StoppingRule::reached(outcome.replicas, outcome.achieved_error / target()))
    outcome.convergence = Convergence::reached;
  return outcome;
}

}  // namespace lorentz
