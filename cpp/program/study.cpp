#include "program/study.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <future>
#include <limits>
#include <new>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

#include "program/build_info.hpp"
#include "program/errors.hpp"
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

/// The element with the largest relative error; one that is not defined comes first.
std::size_t least_accurate(const Quantity& quantity) {
  std::vector<double> errors;
  for (std::size_t k = 0; k < quantity.mean.size(); ++k) {
    const double error = quantity.standard_error[k] / std::abs(quantity.mean[k]);
    errors.push_back(std::isnan(error) ? std::numeric_limits<double>::infinity() : error);
  }
  return static_cast<std::size_t>(std::ranges::max_element(errors) - errors.begin());
}

/// Thrown by a heartbeat to end a replica after another one has failed.
struct Abandoned {};

}  // namespace

StudyProgram::StudyProgram(const std::string& name, const std::string& description)
    : program_(name, description) {}

int StudyProgram::run(int argc, char** argv, const std::function<Study()>& make) {
  Options& options = this->options();
  using enum Role;
  options.integer(effort, "--replicas", replicas_, {1, 100'000'000},
                  "Independent replicas; not with a target error, which determines their number");
  options.required_integer(effort, "--seed", seed_, {},
                           "Key of all random streams; runs with the same seed have correlated results, so "
                           "give each run of a scan its own");
  options.real(effort, "--target-error", target_error_, non_negative, "1",
               fmt::format("Add replicas, {} at least, until the standard error of the target quantity, "
                           "relative to its mean, is below this with 95 % confidence; 0: no target",
                           StoppingRule::least));
  options.real(effort, "--target-scale", target_scale_, non_negative, "",
               "Number in the target quantity's units to which the target error is relative instead, for a "
               "mean that may be 0; 0: the mean");
  options.integer_or_word(execution, "--threads", threads_, {1, 4096}, "processors",
                          "Threads, on which no result depends; processors: one for each");
  options.real(execution, "--checkpoint-interval", checkpoint_interval_, positive, "second",
               "Seconds between checkpoints in OUTPUT.checkpoint");
  options.flag(execution, "--resume", resume_, "Resume from OUTPUT.checkpoint if it exists");
  const auto plan = [&] {
    if (target_error_ > 0) {
      if (options.given("--replicas"))
        throw UsageError(
            "--replicas, --target-error: both determine the number of replicas. Give one of them.");
      options.omit("--replicas");
    }
    study_ = make();
    return quantities();
  };
  return program_.run(argc, argv, plan, [this] { return compute(); });
}

/// The group that estimates this quantity.
const Group& StudyProgram::group_of(const std::string& name) const {
  return *std::ranges::find_if(study_.groups, [&](const Group& group) {
    const std::vector<Description> all = group.descriptions();
    return std::ranges::find(all, name, &Description::name) != all.end();
  });
}

std::vector<Description> StudyProgram::quantities() const {
  std::vector<Description> all;
  for (const Group& group : study_.groups)
    for (Description& what : group.descriptions()) all.push_back(std::move(what));
  const auto target = std::ranges::find(all, study_.target, &Description::name);
  if (target == all.end())
    throw std::logic_error("the study has no quantity named as its target, " + study_.target);
  target->description += " (the target quantity)";
  return all;
}

/// Throws std::bad_alloc if the records, their copy for the estimate, and one corrected by control variates
/// exceed the memory of the machine: the system would kill the program late and without a message.
void StudyProgram::require_memory() const {
  const auto replicas = static_cast<double>(replicas_), width = static_cast<double>(study_.tallies.width());
  const double pages = static_cast<double>(::sysconf(_SC_PHYS_PAGES));
  if (3 * sizeof(double) * replicas * width > pages * static_cast<double>(::sysconf(_SC_PAGESIZE)))
    throw std::bad_alloc();
}

/// Loads the replicas of the checkpoint. Throws UsageError if there is one that neither --resume nor
/// --overwrite refers to.
void StudyProgram::prepare() {
  if (!options().given("--seed"))
    throw UsageError(
        "--seed is missing: random numbers follow from it. Give every run its own, as --seed 1.");
  require_memory();
  checkpoint_.path = program_.output() + ".checkpoint";
  checkpoint_.identity = fmt::format("{} {}", options().option_words(), build_info.source_hash);
  if (std::error_code unknown; std::filesystem::is_regular_file(checkpoint_.path, unknown)) {
    if (resume_) finished_ = checkpoint_.load();
    if (finished_.empty() && !options().given("--overwrite"))
      throw UsageError(fmt::format("'{}' is of {}, or discard it with --overwrite.", checkpoint_.path,
                                   resume_ ? "other options or sources. Choose another --output"
                                           : "a run that ended early. Continue it with --resume"));
  }
  resumed_ = finished_.size();
  next_checkpoint_ = program_.elapsed() + checkpoint_interval_;
  note_signals();
}

ExitStatus StudyProgram::compute() try {
  prepare();
  const StoppingRule rule;
  const std::uint64_t threads = threads_.value_or(std::max(1U, std::thread::hardware_concurrency()));
  needed_ = target_error_ > 0 ? rule.next_look(0) : replicas_;
  for (std::uint64_t wanted = needed_;; wanted = rule.next_look(wanted)) {
    in_threads(std::min(threads, wanted), [&] { measure(wanted); });
    RunResult result;
    in_threads(1, [&] { result = estimate(wanted); });
    const std::vector<double>& errors = quantity_named(result.results, study_.target).standard_error;
    // Exactly 0: all replicas agree, so that more of them do not change the error.
    const bool constant = std::ranges::all_of(errors, [](double error) { return error == 0; });
    const bool last =
        result.convergence != Convergence::not_reached || constant || rule.next_look(wanted) > rule.most;
    const double excess = result.achieved_error / target_error_;
    if (!last && std::isfinite(excess)) {  // the error falls as the inverse square root of the number
      const double expected = static_cast<double>(wanted) * excess * excess;
      needed_ = std::max(rule.next_look(wanted),
                         static_cast<std::uint64_t>(std::min(expected, static_cast<double>(rule.most))));
    }
    report(result, wanted);
    if (!last) continue;
    if (study_.remarks)
      for (const std::string& remark : study_.remarks(result.results)) program_.progress().say(remark);
    const ExitStatus status = program_.write(result);
    ::unlink(checkpoint_.path.c_str());
    return status;
  }
} catch (...) {
  if (!finished_.empty()) checkpoint_on_exit("stopped");
  throw;
}

/// Performs a task in each of some threads, which do not change the finished replicas without the mutex.
/// Meanwhile shows progress and writes checkpoints. After a signal the process ends at once, with a
/// checkpoint. Throws an exception of a task.
void StudyProgram::in_threads(std::uint64_t number, const std::function<void()>& task) {
  const auto perform = [&] {
    try {
      task();
    } catch (const Abandoned&) {
      return;
    } catch (...) {
      failed_ = true;  // every replica stops at its next heartbeat
      throw;
    }
  };
  std::vector<std::future<void>> threads;  // which are joined when it goes out of scope
  try {
    while (threads.size() < number) threads.push_back(std::async(std::launch::async, perform));
  } catch (const std::system_error& error) {
    failed_ = true;
    throw UsageError(fmt::format("--threads: the system starts only {}: {}. Choose fewer.", threads.size(),
                                 error.code().message()));
  }
  const auto attend = [this] {
    const std::scoped_lock lock(mutex_);
    if (received_signal == 0) return show_progress();
    checkpoint_on_exit("interrupted");
    std::_Exit(static_cast<int>(ExitStatus::interrupted) + received_signal);
  };
  for (const std::future<void>& thread : threads)
    while (thread.wait_for(std::chrono::milliseconds(100)) != std::future_status::ready) attend();
  attend();
  for (std::future<void>& thread : threads) thread.get();
}

/// Measures replicas below `end` in the order of the index until none is left or one has failed.
void StudyProgram::measure(std::uint64_t end) {
  double completed = 0;
  const auto heartbeat = [&](double part) {
    if (failed_) throw Abandoned();
    part = std::min(part, 1.);  // a revolution of the queue may end after the run
    const std::scoped_lock lock(mutex_);
    in_progress_ += part - std::exchange(completed, part);
  };
  std::unique_lock lock(mutex_);
  for (;;) {
    while (finished_.contains(next_)) ++next_;
    if (next_ >= end || failed_) break;
    const std::uint64_t index = next_++;
    lock.unlock();
    TallySums sums(study_.tallies);
    const std::uint64_t events = study_.sample({StreamKey(seed_, index), heartbeat}, sums);
    sums.require_filled();
    lock.lock();
    finished_.emplace(index, FinishedReplica{sums.values(), events});
    in_progress_ -= std::exchange(completed, 0);
  }
}

/// The caller holds the mutex.
void StudyProgram::show_progress() {
  program_.progress().show(static_cast<double>(finished_.size()) + in_progress_, needed_,
                           static_cast<double>(resumed_));
  if (warned_ || finished_.empty() || program_.elapsed() < next_checkpoint_) return;
  warned_ = !save("the run goes on without a checkpoint: ");  // the results matter more
  next_checkpoint_ = program_.elapsed() + checkpoint_interval_;
}

/// Writes a checkpoint; if that fails, warns and returns false.
bool StudyProgram::save(const std::string& prefix) try {
  checkpoint_.save(finished_);
  return true;
} catch (const std::exception& error) {
  program_.progress().warn(prefix + error.what());
  return false;
}

/// Saves the replicas when the run ends early, and reports why it ends and how to resume.
void StudyProgram::checkpoint_on_exit(const std::string& why) {
  const std::string state = fmt::format("{} after {}", why, counted(finished_.size()));
  if (finished_.empty()) return program_.progress().say(state);
  if (save(state + ", which are not saved: "))
    program_.progress().say(fmt::format("{}; --resume continues from '{}'", state, checkpoint_.path));
}

/// From the first replicas, which are finished. A resumed run may have others, of later batches.
RunResult StudyProgram::estimate(std::uint64_t replicas) const {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  RunResult result{.target_quantity = study_.target,
                   .target_error = target_error_ > 0 ? target_error_ : none,
                   .former_seconds = checkpoint_.former_seconds};
  Records records(study_.tallies.width(), replicas);
  for (std::uint64_t index = 0; index < replicas; ++index) {
    records.append(finished_.at(index).values);
    result.events += finished_.at(index).events;
  }
  for (const Group& group : study_.groups)
    for (Quantity& quantity : group.estimate(records)) result.results.push_back(std::move(quantity));
  const Quantity& quantity = quantity_named(result.results, study_.target);
  const std::size_t k = least_accurate(quantity);
  const auto relative_error = [&](const Results& results) {
    const Quantity& target = quantity_named(results, study_.target);
    const double mean = target.mean[k], error = target.standard_error[k];
    return error > 0 ? error / (target_scale_ > 0 ? target_scale_ : std::abs(mean)) : none;
  };
  result.achieved_error = relative_error(result.results);
  result.plain_error =
      quantity.control_variates
          ? relative_error(group_of(study_.target).without_control_variates().estimate(records))
          : none;
  if (target_error_ == 0)
    result.convergence = Convergence::no_target;
  else if (std::isfinite(quantity.mean[k]) &&
           StoppingRule::reached(replicas, result.achieved_error / target_error_))
    result.convergence = Convergence::reached;
  return result;
}

/// Reports the target quantity, and how uncertain its error is if the replicas are few.
void StudyProgram::report(const RunResult& result, std::uint64_t replicas) {
  const Quantity& quantity = quantity_named(result.results, study_.target);
  const std::size_t k = least_accurate(quantity);
  const double mean = quantity.mean[k], error = quantity.standard_error[k];
  const std::string name = quantity.mean.size() > 1 ? fmt::format("{}[{}]", study_.target, k) : study_.target;
  std::string line = fmt::format("{}: {} = {}", counted(replicas), name, with_error(mean, error));
  if (result.convergence == Convergence::not_reached) line += ", not reached";
  if (std::isnan(mean))
    line += ", not defined by these replicas";
  else if (std::isnan(error))
    line += ", without a standard error, as it is not defined without one of the replicas; choose more";
  else if (target_error_ > 0 && error == 0)
    line += ": all replicas agree, so that the error is not known";
  if (needed_ > replicas) line += fmt::format("; about {} are needed", needed_);
  if (needed_ > replicas && target_scale_ == 0 && std::abs(mean) < 2 * error)
    line += "; the mean may be 0: choose a --target-scale to which the error is relative";
  program_.progress().say(line);
  // Errors are uncertain by 1/sqrt(2(R-1)) for normal records, and more for skewed ones.
  constexpr std::uint64_t enough = 32;
  if (replicas > 1 && replicas < enough)
    program_.progress().say(fmt::format("standard errors from {} are uncertain by about {:.0f} %",
                                        counted(replicas),
                                        100 / std::sqrt(2.0 * static_cast<double>(replicas - 1))));
  std::size_t needed = 0;
  for (const Quantity& estimated : result.results)
    if (estimated.control_variates) needed = std::max(needed, estimated.control_variates->needed);
  if (replicas < needed)
    program_.progress().say(fmt::format(
        "without control variates, which need {} replicas, errors are larger, often several times; "
        "choose more --replicas",
        needed));
}

}  // namespace lorentz
