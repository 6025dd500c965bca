#include "program/study.hpp"

#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "program/errors.hpp"
#include "program/hdf5_file.hpp"
#include "program/stopping_rule.hpp"
#include "support/temporary_folder.hpp"

namespace study_test {

using namespace lorentz;
using support::content_of;
using support::TemporaryFolder;
using support::write_file;
using Names = std::set<std::string>;
using Indices = std::vector<std::int64_t>;
using Arguments = std::vector<std::string>;

using MeasureValue = std::function<double(const Replica&)>;

/// A number that differs between replicas, with a standard deviation of about 0.3.
double measure(const Replica& replica) {
  return 1 + static_cast<double>((replica.key.replica * 7919 + 13) % 101) / 101;
}

struct ValueTallies : TallySchema {
  ScalarTally value = tally("value", "1", "A number");
};

/// Study of one number per replica.
Study study_of(const MeasureValue& measurement) {
  const ValueTallies tallies;
  Group group;
  group.quantity("value", "1", "A number", [=](TallyMeans mean) { return mean[tallies.value]; });
  return {.tallies = tallies,
          .sample =
              [=](const Replica& replica, TallySums& sums) {
                sums[tallies.value] = measurement(replica);
                return 10;
              },
          .groups = {group},
          .target = "value"};
}

/// Output of the last run on standard error.
std::string complaints;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables): read after the call

/// Runs a program of a study; returns its exit status.
int run_program(Arguments arguments, const std::function<Study()>& make) {
  arguments.insert(arguments.begin(), "example");
  for (const auto& [option, value] : {std::pair{"--progress", "none"}, std::pair{"--seed", "1"}})
    if (std::ranges::find(arguments, option) == arguments.end())
      arguments.insert(arguments.end(), {option, value});
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  StudyProgram program("example", "An example");
  const int status = program.run(static_cast<int>(pointers.size()), pointers.data(), make);
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) ::signal(number, SIG_DFL);  // as before
  return status;
}

int run(const Arguments& arguments, const std::function<Study()>& make) {
  testing::internal::CaptureStderr();
  const int status = run_program(arguments, make);
  complaints = testing::internal::GetCapturedStderr();
  return status;
}

int run(const Arguments& arguments, const MeasureValue& measurement = measure) {
  return run(arguments, [&] { return study_of(measurement); });
}

Arguments with(Arguments arguments, const Arguments& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

/// Measurement that must not be executed.
double never(const Replica&) { throw std::logic_error("measured"); }

/// The last run has printed one line with this part.
void expect_complaint(const std::string& part) {
  EXPECT_TRUE(complaints.starts_with("example: ")) << complaints;
  EXPECT_EQ(complaints.find('\n'), complaints.size() - 1) << complaints;
  EXPECT_NE(complaints.find(part), std::string::npos) << complaints;
}

/// The run is refused in one line with this part, and measures nothing.
void expect_refused_run(const Arguments& arguments, const std::string& part) {
  EXPECT_EQ(run(arguments, never), 2);
  expect_complaint(part);
}

/// Measurement that fails at one replica. The exit status is 3, and the finished replicas are kept.
MeasureValue failing_at(std::uint64_t index) {
  return [index](const Replica& replica) {
    if (replica.key.replica == index) throw NumericalError("a replica failed");
    return measure(replica);
  };
}

std::int64_t replicas_in(const std::string& path) {
  return Hdf5Reader(path).counts("/results/value/count").at(0);
}

Indices replicas_kept(const std::string& path) {
  return Hdf5Reader(path + ".checkpoint").counts("/replicas/index");
}

/// Runs with the output a.h5 in an empty folder.
struct StudyTest : testing::Test {
  TemporaryFolder folder;
  std::string output = folder / "a.h5";
  Arguments to_output{"--threads", "1", "--output", output};

  bool has(const std::string& converged) const {
    return Hdf5Reader(output).has_attribute("/provenance", "converged", converged);
  }
  double mean() const { return Hdf5Reader(output).doubles("/results/value/mean").at(0); }
  double error() const { return Hdf5Reader(output).doubles("/results/value/standard_error").at(0); }
  void expect_same_bytes_as(const Arguments& arguments) const {
    EXPECT_EQ(run(with(arguments, {"--output", folder / "other.h5"})), 0);
    EXPECT_EQ(content_of(output), content_of(folder / "other.h5"));
  }
};

// 0.3 / sqrt(R) / 1.5 is far enough below 0.02 near R = 128; up to there a look follows every 16 replicas.
TEST_F(StudyTest, StopsAtTheTargetErrorOnABatchBoundary) {
  const Arguments target{"--target-error", "0.02"};
  EXPECT_EQ(run(with(to_output, target)), 0);
  EXPECT_TRUE(has("reached"));
  const std::int64_t count = replicas_in(output);
  EXPECT_GT(count, 66U);
  EXPECT_EQ(count % 16, 0U);
  EXPECT_FALSE(Hdf5Reader(output).has_attribute("/parameters", "replicas", std::int64_t{32}));  // the default
  expect_refused_run(with(to_output, {"--overwrite", "--target-error", "0.02", "--replicas", "8"}),
                     "--replicas");
  EXPECT_TRUE(StoppingRule::reached(count, error() / mean() / 0.02));
  expect_same_bytes_as(with(target, {"--threads", "7"}));
  EXPECT_EQ(run({"--output", output, "--overwrite", "--replicas", std::to_string(count - 16)}), 0);
  EXPECT_FALSE(StoppingRule::reached(count - 16, error() / mean() / 0.02));
  EXPECT_EQ(run({"--output", output, "--overwrite", "--target-error", "10"}), 0);
  EXPECT_EQ(replicas_in(output), 64U);  // the least number with a target
}

// The error is within 0.05 after 64 replicas relative to 1, and not relative to 1/4 or to the mean of 0.
TEST_F(StudyTest, ReachesATargetErrorRelativeToAScale) {
  const auto centred = [](const Replica& replica) { return measure(replica) - 1.5; };
  const auto replicas = [&](const char* scale) {
    EXPECT_EQ(
        run(with(to_output, {"--overwrite", "--target-error", "0.05", "--target-scale", scale}), centred), 0);
    EXPECT_TRUE(has("reached"));
    return replicas_in(output);
  };
  EXPECT_EQ(replicas("1"), 64U);
  EXPECT_GT(replicas("0.25"), 500U);
}

TEST_F(StudyTest, GoesOnWithoutACheckpoint) {
  std::filesystem::create_directory(folder / "a.h5.checkpoint");
  const auto slow = [](const Replica& replica) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return measure(replica);
  };
  EXPECT_EQ(run(with(to_output, {"--checkpoint-interval", "0.01"}), slow), 0);
  expect_complaint("a.h5.checkpoint");  // once
  EXPECT_EQ(replicas_in(output), 32U);  // the default
  EXPECT_EQ(run(with(to_output, {"--overwrite"}), failing_at(5)), 3);
  EXPECT_NE(complaints.find("not saved"), std::string::npos) << complaints;
}

TEST_F(StudyTest, KeepsTheReplicasOfResultsThatCannotBeWritten) {
  const auto obstruct = [&](const Replica& replica) {
    if (replica.key.replica == 31) std::filesystem::create_directory(output);
    return measure(replica);
  };
  EXPECT_EQ(run(to_output, obstruct), 2);
  EXPECT_EQ(folder.names(), (Names{"a.h5", "a.h5.checkpoint"}));
  std::filesystem::remove(output);
  EXPECT_EQ(run(with(to_output, {"--resume"}), never), 0);
  expect_same_bytes_as({});
}

TEST_F(StudyTest, ResumesToEqualBytes) {
  EXPECT_EQ(run(to_output, failing_at(21)), 3);
  EXPECT_EQ(folder.names(), Names{"a.h5.checkpoint"});
  EXPECT_EQ(run(with(to_output, {"--resume"}), failing_at(25)), 3);
  Indices measured;
  const auto remember = [&](const Replica& replica) {
    measured.push_back(replica.key.replica);
    return measure(replica);
  };
  EXPECT_EQ(run(with(to_output, {"--resume"}), remember), 0);
  EXPECT_EQ(measured, (Indices{25, 26, 27, 28, 29, 30, 31}));
  EXPECT_EQ(folder.names(), (Names{"a.h5", "a.cost.json"}));
  expect_same_bytes_as({"--resume"});  // without a checkpoint
}

// Looks take place only where an uninterrupted run has them: after 64, 80, 96, ... replicas.
TEST_F(StudyTest, ResumesToTheSameBatchBoundary) {
  const Arguments target{"--target-error", "0.02"};
  EXPECT_EQ(run(with(to_output, target), failing_at(73)), 3);
  EXPECT_EQ(run(with(with(to_output, target), {"--resume"})), 0);
  expect_same_bytes_as(target);
}

TEST_F(StudyTest, DiscardsACheckpointOnlyWithOverwrite) {
  EXPECT_EQ(run(to_output, failing_at(5)), 3);
  const std::string before = content_of(folder / "a.h5.checkpoint");
  for (const Arguments& more : {Arguments{}, {"--seed", "2"}, {"--seed", "2", "--resume"}})
    expect_refused_run(with(to_output, more), "a.h5.checkpoint");
  EXPECT_EQ(content_of(folder / "a.h5.checkpoint"), before);
  std::string damaged = before;
  damaged[damaged.size() / 2] ^= 1;
  write_file(folder / "a.h5.checkpoint", damaged);
  expect_refused_run(with(to_output, {"--resume"}), "damaged");
  write_file(folder / "a.h5.checkpoint", before);
  EXPECT_EQ(run(with(to_output, {"--resume", "--overwrite", "--seed", "2"})), 0);
  EXPECT_FALSE(folder.names().contains("a.h5.checkpoint"));
  expect_same_bytes_as({"--seed", "2"});
}

TEST_F(StudyTest, ReplacesNoResultOfOtherOptions) {
  EXPECT_EQ(run(to_output), 0);
  EXPECT_EQ(run({"--output", output, "--threads", "2"}), 0);
  const std::string before = content_of(output);
  expect_refused_run(with(to_output, {"--seed", "2"}), "--overwrite");
  EXPECT_EQ(content_of(output), before);
  EXPECT_EQ(run(with(to_output, {"--seed", "2", "--overwrite"})), 0);
  expect_refused_run(to_output, "--overwrite");
  write_file(output, "notes");
  expect_refused_run(to_output, "a.h5");
}

TEST_F(StudyTest, LeavesNothingBehindIfItIsRefusedOrFails) {
  expect_refused_run({"--output", folder / "absent/a.h5"}, "absent/a.h5");
  EXPECT_EQ(run(to_output, failing_at(0)), 3);
  expect_complaint("a replica failed");
  EXPECT_EQ(run(to_output, never), 5);
  expect_complaint("measured");
  EXPECT_EQ(folder.names(), Names{});
}

// Detected mistake: a tally that is never filled, which would be 0 in every result.
TEST_F(StudyTest, WithATallyThatIsNeverFilledIsRefused) {
  const auto forgetful = [] {
    Study study = study_of(measure);
    study.tallies.tally("forgotten", {numbered_axis("site", "Where", 3)}, "1", "Three numbers");
    return study;
  };
  EXPECT_EQ(run(to_output, forgetful), 5);
  expect_complaint("forgotten");
}

// The other replica never ends, so the test terminates only if its heartbeat throws.
TEST_F(StudyTest, OneFailureStopsTheOtherReplicas) {
  std::atomic<bool> other_runs{false};
  const auto fail_or_go_on = [&other_runs](const Replica& replica) -> double {
    while (replica.key.replica == 0 && !other_runs) std::this_thread::yield();
    if (replica.key.replica == 0) throw NumericalError("the first");
    for (other_runs = true;; std::this_thread::sleep_for(std::chrono::milliseconds(1)))
      replica.heartbeat(0.5);
  };
  EXPECT_EQ(run({"--output", output, "--threads", "2", "--replicas", "2"}, fail_or_go_on), 3);
  expect_complaint("the first");
}

/// Raises a signal, and then takes long.
void interrupt(int number) {
  ::raise(number);
  std::this_thread::sleep_for(std::chrono::minutes(5));
}

// The program runs in a separate process, which a signal ends. No replica has a heartbeat: the first three
// are too short, and the fourth is interrupted during its setup.
TEST_F(StudyTest, SignalsEndTheRunWithACheckpoint) {
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
    const auto killed = [number](const Replica& replica) {
      if (replica.key.replica == 3) interrupt(number);
      return measure(replica);
    };
    ::signal(SIGHUP, SIG_DFL);  // under nohup these tests would ignore it
    EXPECT_EXIT(run_program(with(to_output, {"--overwrite"}), [&] { return study_of(killed); }),
                testing::ExitedWithCode(128 + number), "");
    EXPECT_EQ(replicas_kept(output), (Indices{0, 1, 2}));
  }
  const auto estimating = [] {
    Study study = study_of(measure);
    study.groups.front().statistics({{"more", "1", "Another"}}, [](const Records&) -> Estimates {
      interrupt(SIGINT);
      return {{1}, {0}};
    });
    return study;
  };
  EXPECT_EXIT(run_program(with(to_output, {"--overwrite"}), estimating),
              testing::ExitedWithCode(128 + SIGINT), "");
  EXPECT_EQ(replicas_kept(output).size(), 32U);
  EXPECT_EQ(folder.names(), Names{"a.h5.checkpoint"});
}

}  // namespace study_test
