#include "program/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <new>
#include <thread>
#include <utility>

#include "numerics/random.hpp"
#include "program/build_info.hpp"
#include "program/checkpoint.hpp"
#include "program/errors.hpp"
#include "program/parts.hpp"
#include "program/stopping_rule.hpp"

namespace lorentz {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

Clock::time_point later(double seconds) {
  constexpr double for_ever = 1e9;  // seconds: longer than any run, without overflow of the clock
  if (seconds > for_ever) return Clock::time_point::max();
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(Seconds(seconds));
}

/// Replicas 0, 1, ... up to the first one missing, at most `wanted`. A resumed run may have others, of later
/// batches or finished out of order.
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

Results estimate_all(const Study& study, const Records& records) {
  Results results;
  for (const Estimator& estimator : study.estimators)
    for (Quantity& quantity : estimator.estimate(records)) results.push_back(std::move(quantity));
  return results;
}

const Quantity& quantity_named(const Results& results, const std::string& name) {
  const auto found =
      std::ranges::find_if(results, [&](const Quantity& quantity) { return quantity.what.name == name; });
  if (found == results.end()) throw std::logic_error("no quantity named " + name);
  return *found;
}

/// Standard error of a number, relative to its modulus unless `absolute`. An error of exactly 0 is 0 either
/// way.
double error_of(const Quantity& target, bool absolute) {
  const double error = target.standard_error.front();
  return absolute || error == 0 ? error : error / std::abs(target.mean.front());
}

Convergence convergence_of(bool complete, bool has_target, bool reached) {
  if (!complete) return Convergence::not_reached;
  if (!has_target) return Convergence::no_target;
  return reached ? Convergence::reached : Convergence::not_reached;
}

/// Warns that errors from few replicas are uncertain, by 1/sqrt(2(R-1)) for normal records and more for
/// skewed ones.
void warn_of_few(std::size_t replicas, Progress& progress) {
  constexpr std::size_t enough = 32;
  if (replicas > 1 && replicas < enough)
    progress.say(fmt::format("standard errors from {} replicas are uncertain by about {:.0f} %", replicas,
                             100 / std::sqrt(2.0 * static_cast<double>(replicas - 1))));
}

/// Run of a study, batch by batch.
class StudyRun {
 public:
  StudyRun(const Study& study, const ReplicaParameters& parameters, const Program& program,
           Progress& progress)
      : study_(study),
        parameters_(parameters),
        progress_(progress),
        format_(
            fmt::format("{}build_id = {}\n", as_text(program.options().parameters()), build_info.build_id),
            study.tallies.tallies()),
        checkpoint_(program.output(), format_),
        absolute_(parameters.target_absolute > 0),
        target_(absolute_ ? parameters.target_absolute : parameters.target_error),
        deadline_(parameters.time_limit > 0 ? later(parameters.time_limit) : Clock::time_point::max()),
        rule_{.batch = parameters.replicas, .most = parameters.max_replicas} {
    program.options().require_not_configuration(checkpoint_.path());
  }

  Outcome run() try {
    if (parameters_.resume)
      finished_ = checkpoint_.load([this](const std::string& line) { progress_.warn(line); });
    if (!parameters_.join.empty()) finished_.merge(join(parameters_.join, format_));
    resumed_ = finished_.size();
    next_checkpoint_ = later(parameters_.checkpoint_interval);
    Outcome outcome = parameters_.part.empty() ? whole() : part();
    outcome.after_writing = [checkpoint = checkpoint_, finished = std::move(finished_),
                             &progress = progress_](bool written) {
      if (written)
        checkpoint.remove();
      else
        keep(checkpoint, finished, progress, "the results cannot be written");
    };
    return outcome;
  } catch (const Interrupted&) {
    keep(checkpoint_, finished_, progress_, "interrupted");
    throw;
  } catch (const std::bad_alloc&) {
    keep(checkpoint_, finished_, progress_, "out of memory");
    throw;
  }

 private:
  /// Saves the replicas when the run ends early, and says why it ends and what becomes of them.
  static void keep(const Checkpoint& checkpoint, const FinishedReplicas& finished, Progress& progress,
                   const std::string& why) try {
    checkpoint.save(finished);
    if (finished.empty()) return progress.say(why + " before the first replica was finished");
    progress.say(fmt::format("{} after {} replicas; --resume continues from '{}'", why, finished.size(),
                             checkpoint.path()));
  } catch (const UsageError& error) {
    progress.warn(
        fmt::format("{} after {} replicas, which are not saved: {}", why, finished.size(), error.what()));
  }

  /// Batch by batch until the last.
  Outcome whole() {
    needed_ = target_ > 0 ? rule_.next_look(0) : parameters_.replicas;
    for (std::uint64_t wanted = needed_;; wanted = rule_.next_look(wanted)) {
      measure(0, wanted);
      Outcome outcome = outcome_of(wanted);
      if (!is_last(outcome, wanted)) continue;
      warn_of_few(outcome.replicas, progress_);
      return outcome;
    }
  }

  Outcome part() {
    const Part part = Part::from(parameters_.part, parameters_.replicas);
    needed_ = part.size();
    measure(part.first, part.last + 1);
    progress_.say(fmt::format("replicas {} to {} are measured, for --join", part.first, part.last));
    Outcome outcome{.convergence = Convergence::no_target, .part = format_.content(finished_)};
    for (const auto& [index, record] : finished_) outcome.events += record.events;
    return outcome;
  }

  /// Replicas first ... end - 1, but for those that are finished.
  void measure(std::uint64_t first, std::uint64_t end) {
    const auto measure_one = [this](const Replica& replica) {
      Record record(study_.tallies);
      const std::uint64_t events = study_.measure(replica, record);
      return ReplicaRecord{record.values(), events};
    };
    const auto report = [this](double done, const FinishedReplicas& so_far) {
      progress_.show(done, static_cast<double>(needed_), static_cast<double>(resumed_));
      if (Clock::now() < next_checkpoint_) return;
      save_on_the_way(so_far);
      next_checkpoint_ = later(parameters_.checkpoint_interval);
    };
    const auto warn = [this](const std::string& line) { progress_.warn(line); };
    const auto abandon = [this](int signal, const FinishedReplicas& so_far) {
      keep(checkpoint_, so_far, progress_, "interrupted");
      std::_Exit(static_cast<int>(ExitStatus::interrupted) + signal);
    };
    run_replicas({parameters_.seed, first, end, parameters_.threads, deadline_, report, warn, abandon},
                 measure_one, finished_);
  }

  /// The results matter more than a checkpoint, so the run goes on without one, and says so once.
  void save_on_the_way(const FinishedReplicas& so_far) try {
    checkpoint_.save(so_far);
  } catch (const UsageError& error) {
    if (!std::exchange(warned_, true))
      progress_.warn(fmt::format("the run goes on without a checkpoint: {}", error.what()));
  }

  Outcome outcome_of(std::uint64_t wanted) const {
    const FinishedReplicas used = first_of(finished_, wanted);
    Outcome outcome{.results = estimate_all(study_, as_records(used)),
                    .seed = parameters_.seed,
                    .streams = RandomStream::description,
                    .target_quantity = study_.target,
                    .target_error = target_ > 0 ? target_ : std::numeric_limits<double>::quiet_NaN(),
                    .replicas = used.size()};
    for (const auto& [index, record] : used) outcome.events += record.events;
    const Quantity& quantity = quantity_named(outcome.results, study_.target);
    outcome.achieved_error = error_of(quantity, absolute_);
    const bool complete = used.size() == wanted && std::isfinite(quantity.mean.front());
    outcome.convergence =
        convergence_of(complete, target_ > 0, StoppingRule::reached(used.size(), excess(outcome)));
    return outcome;
  }

  double excess(const Outcome& outcome) const { return outcome.achieved_error / target_; }

  /// Whether the run ends after this batch. Prints the estimate and, if more batches follow, the predicted
  /// numbers of replicas.
  bool is_last(const Outcome& outcome, std::uint64_t wanted) {
    const bool not_reached = outcome.convergence == Convergence::not_reached;
    const bool last = !not_reached || outcome.replicas < wanted || target_ == 0 ||
                      wanted + parameters_.replicas > parameters_.max_replicas;
    std::string forecast;
    if (!last && std::isfinite(excess(outcome))) {
      const StoppingRule::Forecast end = rule_.forecast(outcome.replicas, excess(outcome));
      needed_ = end.likely;
      forecast = fmt::format("; the run ends after {} to {}", end.low, end.high);
    }
    const Quantity& quantity = quantity_named(outcome.results, study_.target);
    progress_.say(fmt::format("{} replicas: {} = {:.8g} +- {:.2g}{}{}", outcome.replicas, study_.target,
                              quantity.mean.front(), quantity.standard_error.front(),
                              not_reached ? ", not reached" : "", forecast));
    return last;
  }

  const Study& study_;
  const ReplicaParameters& parameters_;
  Progress& progress_;
  RecordFile format_;
  Checkpoint checkpoint_;
  bool absolute_;
  double target_;  // 0: none
  Clock::time_point deadline_, next_checkpoint_;
  StoppingRule rule_;
  FinishedReplicas finished_;
  std::size_t resumed_ = 0;
  std::uint64_t needed_ = 0;  // predicted number of replicas in all
  bool warned_ = false;       // of a checkpoint that cannot be written
};

}  // namespace

Outcome run_study(const Study& study, const ReplicaParameters& parameters, const Program& program,
                  Progress& progress) {
  require_consistent(parameters, program.options(), program.output());
  return StudyRun(study, parameters, program, progress).run();
}

namespace {

/// Throws std::logic_error if no quantity has the name of the target.
Study checked(Study study) {
  for (const Estimator& estimator : study.estimators)
    for (const Description& quantity : estimator.quantities)
      if (quantity.name == study.target) return study;
  throw std::logic_error("the study has no quantity named as its target, " + study.target);
}

}  // namespace

int StudyProgram::run(int argc, char** argv, const std::function<Study()>& make) {
  parameters_.threads = std::max(1U, std::thread::hardware_concurrency());
  declare(program_.options(), parameters_);
  const auto describe = [&] {
    std::vector<Description> quantities;
    for (const Estimator& estimator : checked(make()).estimators)
      quantities.insert(quantities.end(), estimator.quantities.begin(), estimator.quantities.end());
    return quantities;
  };
  return program_.run(argc, argv, describe, [&](Progress& progress) {
    return run_study(checked(make()), parameters_, program_, progress);
  });
}

}  // namespace lorentz
