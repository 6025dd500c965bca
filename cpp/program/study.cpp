#include "program/study.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <new>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

#include "numerics/random.hpp"
#include "program/atomic_file.hpp"
#include "program/build_info.hpp"
#include "program/errors.hpp"
#include "program/interruption.hpp"

namespace lorentz {
namespace {

using Clock = std::chrono::steady_clock;

Clock::time_point later(double seconds) {
  constexpr double for_ever = 1e9;  // seconds: longer than any run, without overflow of the clock
  if (seconds > for_ever) return Clock::time_point::max();
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

/// First and last replica of "24-47". Throws UsageError if the text is no range of so many replicas.
std::pair<std::uint64_t, std::uint64_t> range_of(const std::string& text, std::uint64_t replicas) {
  std::uint64_t first = 0, last = 0;
  const char* const end = text.data() + text.size();
  const auto dash = std::from_chars(text.data(), end, first).ptr;
  if (dash == text.data() || dash == end || *dash != '-' || std::from_chars(dash + 1, end, last).ptr != end ||
      dash + 1 == end || first > last || last >= replicas)
    throw UsageError(fmt::format(
        "--part {} is no range of replicas. Give the first and the last, as 0-{}, of a run that has {}.",
        text, replicas - 1, replicas));
  return {first, last};
}

const Quantity& quantity_named(const Results& results, const std::string& name) {
  return *std::ranges::find(results, name, [](const Quantity& each) { return each.what.name; });
}

}  // namespace

StudyProgram::StudyProgram(const std::string& name, const std::string& description)
    : Program(name, description), threads_(std::max(1U, std::thread::hardware_concurrency())) {}

int StudyProgram::run(int argc, char** argv, std::function<Study()> make) {
  constexpr auto runtime = Options::Role::runtime;
  options().integer("--replicas", replicas_, {1, 100'000'000},
                    "Independent replicas; with a target error, replicas per batch");
  options().integer("--max-replicas", max_replicas_, {1, 100'000'000},
                    "Largest number of replicas with a target error");
  options().integer("--seed", seed_, {}, "Key of all random streams");
  options().real("--target-error", target_error_, non_negative, "1",
                 fmt::format("Add replicas, {} at least, until the relative standard error of the target "
                             "quantity is below this with 95 % confidence; 0: no target",
                             StoppingRule::least));
  options().real("--target-absolute", target_absolute_, non_negative, "that of the target quantity",
                 "The same for the standard error itself; 0: no target");
  options().integer("--threads", threads_, {1, 4096}, "Threads; no result depends on them", runtime);
  options().real(
      "--time-limit", time_limit_, non_negative, "s",
      "Seconds after which no replica but the first two starts; those in progress are finished; 0: none",
      runtime);
  options().real("--checkpoint-interval", checkpoint_interval_, positive, "s",
                 "Seconds between checkpoints in OUTPUT.checkpoint", runtime);
  options().flag("--resume", resume_, "Resume from OUTPUT.checkpoint if it exists", runtime);
  options().text(
      "--part", part_,
      "Measure only these replicas, as 24-47, and write their records, to be joined; OUTPUT ends with .part",
      runtime);
  options().text("--join", join_,
                 "Take over what the parts in this folder have measured, and measure the rest", runtime);
  make_ = std::move(make);
  return Program::run(argc, argv);
}

std::vector<Description> StudyProgram::quantities() {
  study_ = make_();
  std::vector<Description> all;
  for (const Group& group : study_.groups)
    for (Description& what : group.descriptions()) all.push_back(std::move(what));
  if (std::ranges::find(all, study_.target, &Description::name) == all.end())
    throw std::logic_error("the study has no quantity named as its target, " + study_.target);
  return all;
}

/// Throws UsageError if options that are valid one by one exclude each other.
void StudyProgram::require_consistent() {
  const bool has_target = target_error_ > 0 || target_absolute_ > 0;
  if (target_error_ > 0 && target_absolute_ > 0)
    throw UsageError(
        "--target-error and --target-absolute are both given: a run has one target. Leave out one of the "
        "two.");
  if ((has_target || options().given("--max-replicas")) && max_replicas_ < replicas_)
    throw UsageError(
        fmt::format("--max-replicas {} is below --replicas {}: not even one batch would be allowed. Choose a "
                    "smaller batch "
                    "or a larger maximum.",
                    max_replicas_, replicas_));
  if (part_.empty()) return;
  if (has_target || time_limit_ > 0 || !join_.empty())
    throw UsageError(
        "--part is given with a target error, a time limit or --join: a part has a fixed number of replicas. "
        "Leave out one of the two.");
  if (!output().ends_with(RecordFile::part_suffix))
    throw UsageError(fmt::format("--part writes records, not results. Let --output '{}' end with {}.",
                                 output(), RecordFile::part_suffix));
}

Outcome StudyProgram::compute() try {
  require_consistent();
  quantities();
  std::string identity;
  for (const Parameter& each : options().parameters())
    identity += fmt::format("{} = {}\n", each.name, as_text(each.value));
  format_.emplace(fmt::format("{}build_id = {}\n", identity, build_info.build_id), study_.tallies.tallies());
  checkpoint_ = output() + ".checkpoint";
  if (resume_) load_checkpoint();
  if (!join_.empty()) finished_.merge(format_->join(join_));
  resumed_ = finished_.size();
  deadline_ = time_limit_ > 0 ? later(time_limit_) : Clock::time_point::max();
  next_checkpoint_ = later(checkpoint_interval_);
  note_signals();
  return part_.empty() ? whole() : part();
} catch (const Interrupted&) {
  keep("interrupted");
  throw;
} catch (const std::bad_alloc&) {
  keep("out of memory");
  throw;
}

void StudyProgram::load_checkpoint() {
  std::error_code unknown;
  if (!std::filesystem::exists(checkpoint_, unknown)) return;
  std::optional<FinishedReplicas> saved = format_->read(checkpoint_);
  if (saved)
    finished_ = std::move(*saved);
  else
    progress().warn(fmt::format(
        "'{}' is of other options or another build and is ignored; the run starts anew", checkpoint_));
}

/// Writes a checkpoint; if that fails, warns and returns false.
bool StudyProgram::save(const std::string& prefix) try {
  if (!finished_.empty()) write_atomically(checkpoint_, format_->content(finished_));
  return true;
} catch (const UsageError& error) {
  progress().warn(prefix + error.what());
  return false;
}

/// Saves the replicas when the run ends early, and reports why it ends and how to resume.
void StudyProgram::keep(const std::string& why) {
  if (finished_.empty()) return progress().say(why + " before the first replica was finished");
  if (save(fmt::format("{} after {} replicas, which are not saved: ", why, finished_.size())))
    progress().say(fmt::format("{} after {} replicas; --resume continues from '{}'", why, finished_.size(),
                               checkpoint_));
}

void StudyProgram::after_writing(bool written) {
  if (written)
    ::unlink(checkpoint_.c_str());
  else
    keep("the results cannot be written");
}

/// Batch by batch until the last.
Outcome StudyProgram::whole() {
  const bool has_target = target_error_ > 0 || target_absolute_ > 0;
  const StoppingRule rule{.batch = replicas_, .most = max_replicas_};
  needed_ = has_target ? rule.next_look(0) : replicas_;
  for (std::uint64_t wanted = needed_;; wanted = rule.next_look(wanted)) {
    measure(0, wanted);
    Outcome outcome = estimate(wanted);
    if (!is_last(outcome, wanted)) continue;
    // Errors are uncertain by 1/sqrt(2(R-1)) for normal records, and more for skewed ones.
    constexpr std::size_t enough = 32;
    if (outcome.replicas > 1 && outcome.replicas < enough)
      progress().say(fmt::format("standard errors from {} replicas are uncertain by about {:.0f} %",
                                 outcome.replicas,
                                 100 / std::sqrt(2.0 * static_cast<double>(outcome.replicas - 1))));
    return outcome;
  }
}

Outcome StudyProgram::part() {
  const auto [first, last] = range_of(part_, replicas_);
  std::error_code unknown;
  if (!options().given("--overwrite") && std::filesystem::exists(output(), unknown)) {
    const std::optional<FinishedReplicas> former = format_->read(output());
    if (!former || former->begin()->first != first || former->rbegin()->first != last)
      throw UsageError(fmt::format(
          "'{}' exists and is of other options, another build or other replicas. Choose another --output, or "
          "replace it with --overwrite.",
          output()));
  }
  needed_ = last - first + 1;
  measure(first, last + 1);
  progress().say(fmt::format("replicas {} to {} are measured, for --join", first, last));
  Outcome outcome{.convergence = Convergence::no_target, .part = format_->content(finished_)};
  for (const auto& [index, record] : finished_) outcome.events += record.events;
  return outcome;
}

/// Measures the replicas first ... end - 1 but those that are finished, in the order of the index, each in
/// one thread. Returns when all are finished, or after the deadline when those in progress are; the finished
/// ones then have the lowest indices. Throws Interrupted after a signal, or the first exception of a replica.
void StudyProgram::measure(std::uint64_t first, std::uint64_t end) {
  next_ = first;
  active_ = std::min<std::uint64_t>(threads_, end - first);
  std::vector<std::atomic<double>> fractions(active_);  // of the replicas in progress
  std::vector<std::jthread> threads;
  try {
    for (auto& fraction : fractions) threads.emplace_back([&, end] { work(fraction, end); });
  } catch (const std::system_error& error) {
    failed_ = true;
    throw UsageError(fmt::format("--threads {}: the system starts only {}: {}. Choose fewer.", threads_,
                                 threads.size(), error.code().message()));
  }
  constexpr std::chrono::milliseconds interval(100);
  int intervals_since_signal = 0;
  std::unique_lock lock(mutex_);
  while (!changed_.wait_for(lock, interval, [this] { return active_ == 0; })) {
    report(fractions);
    // A replica that is being set up has no heartbeat.
    if (const int signal = received_signal(); signal != 0 && ++intervals_since_signal > 10) {
      keep("interrupted");
      std::_Exit(static_cast<int>(ExitStatus::interrupted) + signal);
    }
  }
  if (failure_) std::rethrow_exception(failure_);
}

/// Takes replicas until there is none, after a failure, and after the deadline except for the first two.
void StudyProgram::work(std::atomic<double>& fraction, std::uint64_t end) {
  const auto heartbeat = [&](double part) {
    fraction.store(part, std::memory_order_relaxed);
    if (const int signal = received_signal()) throw Interrupted(signal);
    if (failed_.load(std::memory_order_relaxed)) throw Interrupted(0);
  };
  std::unique_lock lock(mutex_);
  for (;;) {
    while (finished_.contains(next_)) ++next_;
    if (next_ >= end || failed_ || (next_ >= 2 && Clock::now() >= deadline_)) break;
    const std::uint64_t index = next_++;
    lock.unlock();
    try {
      heartbeat(0);  // a short replica may not call it itself
      Record record(study_.tallies);
      const std::uint64_t events = study_.measure({StreamKey(seed_, index), heartbeat}, record);
      record.require_filled(study_.tallies);
      lock.lock();
      finished_.emplace(index, ReplicaRecord{record.values(), events});
    } catch (...) {
      if (!lock.owns_lock()) lock.lock();
      if (!failure_) failure_ = std::current_exception();
      failed_ = true;  // every other replica stops at its next heartbeat
    }
    fraction.store(0, std::memory_order_relaxed);
  }
  --active_;
  changed_.notify_one();
}

/// The caller holds the mutex.
void StudyProgram::report(const std::vector<std::atomic<double>>& fractions) {
  auto done = static_cast<double>(finished_.size());
  for (const auto& fraction : fractions) done += fraction.load(std::memory_order_relaxed);
  progress().show(done, static_cast<double>(needed_), static_cast<double>(resumed_));
  if (warned_ || Clock::now() < next_checkpoint_) return;
  warned_ = !save("the run goes on without a checkpoint: ");  // the results matter more
  next_checkpoint_ = later(checkpoint_interval_);
}

/// From the replicas 0, 1, ... up to the first one missing, at most `wanted`. A resumed run may have others,
/// of later batches or finished out of order.
Outcome StudyProgram::estimate(std::uint64_t wanted) const {
  const double target = std::max(target_error_, target_absolute_);
  Outcome outcome{.seed = seed_,
                  .streams = RandomStream::description,
                  .target_quantity = study_.target,
                  .target_error = target > 0 ? target : std::numeric_limits<double>::quiet_NaN()};
  Records records(study_.tallies.width());
  for (const auto& [index, record] : finished_) {
    if (index != records.size() || index == wanted) break;
    records.append(record.values);
    outcome.events += record.events;
  }
  outcome.replicas = records.size();
  for (const Group& group : study_.groups)
    for (Quantity& quantity : group.estimate(records)) outcome.results.push_back(std::move(quantity));
  const Quantity& quantity = quantity_named(outcome.results, study_.target);
  const double mean = quantity.mean.front(), error = quantity.standard_error.front();
  outcome.achieved_error = target_absolute_ > 0 || error == 0 ? error : error / std::abs(mean);
  const bool complete = outcome.replicas == wanted && std::isfinite(mean);
  if (complete && target == 0) outcome.convergence = Convergence::no_target;
  if (complete && target > 0 && StoppingRule::reached(outcome.replicas, outcome.achieved_error / target))
    outcome.convergence = Convergence::reached;
  return outcome;
}

/// Whether the run ends after this batch. Prints the estimate and, if more batches follow, the predicted
/// numbers of replicas.
bool StudyProgram::is_last(const Outcome& outcome, std::uint64_t wanted) {
  const bool not_reached = outcome.convergence == Convergence::not_reached;
  const double target = std::max(target_error_, target_absolute_), excess = outcome.achieved_error / target;
  const bool last =
      !not_reached || outcome.replicas < wanted || target == 0 || wanted + replicas_ > max_replicas_;
  std::string forecast;
  if (!last && std::isfinite(excess)) {
    const auto end = StoppingRule{replicas_, max_replicas_}.forecast(outcome.replicas, excess);
    needed_ = end.likely;
    forecast = fmt::format("; the run ends after {} to {}", end.low, end.high);
  }
  const Quantity& quantity = quantity_named(outcome.results, study_.target);
  progress().say(fmt::format("{} replicas: {} = {}{}{}", outcome.replicas, study_.target,
                             with_error(quantity.mean.front(), quantity.standard_error.front()),
                             not_reached ? ", not reached" : "", forecast));
  return last;
}

}  // namespace lorentz
