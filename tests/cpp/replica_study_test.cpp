#include "program/replica_study.hpp"

#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "program/hdf5_file.hpp"
#include "statistics/jackknife.hpp"
#include "support/temporary_folder.hpp"

namespace {

using namespace lorentz;
using support::content_of;
using support::TemporaryFolder;
using Arguments = std::vector<std::string>;
using Names = std::set<std::string>;

/// A number that differs between replicas, with a standard deviation of about 0.3.
ReplicaRecord measure(const Replica& replica) {
  return {{1 + static_cast<double>((replica.index * 7919 + 13) % 101) / 101}, 10};
}

Results summarise(const Records& records) {
  const Estimate mean =
      jackknife(records, [](std::span<const double> m) { return std::vector(m.begin(), m.end()); });
  return {{"value", "1", "A number", mean.mean, mean.standard_error, {records.size()}, {}}};
}

/// Runs a program of one study to its exit status.
int run(Arguments arguments, const Measurement& measurement = measure) {
  arguments.insert(arguments.begin(), "example");
  arguments.insert(arguments.end(), {"--progress", "none"});
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  Program program("example", "An example");
  const ReplicaOptions replicas(program);
  const int status = program.run(static_cast<int>(pointers.size()), pointers.data(), [&](Progress& progress) {
    return replicas.run({measurement, summarise, "value", "none"}, progress);
  });
  for (const int number : {SIGINT, SIGTERM}) ::signal(number, SIG_DFL);  // the tests may be stopped again
  return status;
}

/// The measurement, stopped like by a signal at one replica.
Measurement interrupted_at(std::uint64_t index) {
  return [index](const Replica& replica) {
    if (replica.index == index) throw Interrupted(SIGINT);
    return measure(replica);
  };
}

std::uint64_t replicas_in(const std::string& path) {
  return Hdf5Reader(path).counts("/results/value/count").at(0);
}

TEST(ReplicaStudy, WritesEqualBytesForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  EXPECT_EQ(run({"--output", folder / "a.h5", "--threads", "1"}), 0);
  EXPECT_EQ(run({"--output", folder / "b.h5", "--threads", "5"}), 0);
  EXPECT_EQ(content_of(folder / "a.h5"), content_of(folder / "b.h5"));
  EXPECT_EQ(folder.names(), (Names{"a.h5", "a.cost.json", "b.h5", "b.cost.json"}));
  EXPECT_EQ(replicas_in(folder / "a.h5"), 16U);
}

// Without the checkpoint its last replica would wait for ten seconds.
TEST(ReplicaStudy, WritesCheckpointsOnTheWay) {
  const TemporaryFolder folder;
  bool seen = false;
  const auto wait_for_checkpoint = [&](const Replica& replica) {
    for (int i = 0; replica.index == 15 && !seen && i < 1000; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      seen = folder.names().contains("a.h5.checkpoint");
    }
    return measure(replica);
  };
  EXPECT_EQ(run({"--output", folder / "a.h5", "--threads", "1", "--checkpoint-interval", "0.01"},
                wait_for_checkpoint),
            0);
  EXPECT_TRUE(seen);
  EXPECT_EQ(folder.names(), (Names{"a.h5", "a.cost.json"}));
}

TEST(ReplicaStudy, ResumesToEqualBytes) {
  const TemporaryFolder folder;
  const Arguments common = {"--threads", "1", "--output"};
  const auto with = [&](const std::string& name, const Arguments& more) {
    Arguments arguments = common;
    arguments.push_back(folder / name);
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  };
  EXPECT_EQ(run(with("whole.h5", {})), 0);
  EXPECT_EQ(run(with("parts.h5", {}), interrupted_at(5)), 128 + SIGINT);
  EXPECT_EQ(folder.names(), (Names{"whole.h5", "whole.cost.json", "parts.h5.checkpoint"}));
  EXPECT_EQ(run(with("parts.h5", {"--resume"}), interrupted_at(9)), 128 + SIGINT);

  // Other parameters: refused, and the checkpoint stays.
  EXPECT_EQ(run(with("parts.h5", {"--resume", "--seed", "2"})), 2);
  EXPECT_TRUE(folder.names().contains("parts.h5.checkpoint"));

  std::set<std::uint64_t> measured;
  EXPECT_EQ(run(with("parts.h5", {"--resume"}),
                [&](const Replica& replica) {
                  measured.insert(replica.index);
                  return measure(replica);
                }),
            0);
  EXPECT_EQ(measured, (std::set<std::uint64_t>{9, 10, 11, 12, 13, 14, 15}));
  EXPECT_EQ(content_of(folder / "parts.h5"), content_of(folder / "whole.h5"));
  EXPECT_FALSE(folder.names().contains("parts.h5.checkpoint"));
  EXPECT_EQ(run(with("fresh.h5", {"--resume"})), 0);  // nothing to go on from
  EXPECT_EQ(content_of(folder / "fresh.h5"), content_of(folder / "whole.h5"));
}

// 0.3 / sqrt(R) / 1.5 falls below 0.02 near R = 100, and the error is looked at after every 8.
TEST(ReplicaStudy, StopsAtTheTargetErrorOnABatchBoundary) {
  const TemporaryFolder folder;
  const Arguments batches = {"--replicas", "8", "--output", folder / "a.h5"};
  const auto with = [&](const Arguments& more) {
    Arguments arguments = batches;
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  };
  EXPECT_EQ(with({"--target-error", "0.02"}), 0);
  const std::uint64_t count = replicas_in(folder / "a.h5");
  EXPECT_EQ(count % 8, 0U);
  const Hdf5Reader file(folder / "a.h5");
  const double relative =
      file.doubles("/results/value/standard_error")[0] / file.doubles("/results/value/mean")[0];
  EXPECT_LE(relative, 0.02);
  Records fewer(1);
  for (std::uint64_t index = 0; index < count - 8; ++index) fewer.append(measure({index, {}}).values);
  const Quantity before = summarise(fewer)[0];
  EXPECT_GT(before.standard_error[0] / before.mean[0], 0.02);  // one batch less would not have done

  EXPECT_EQ(with({"--target-error", "1e-6", "--max-replicas", "20"}), 4);
  EXPECT_EQ(replicas_in(folder / "a.h5"), 16U);
  EXPECT_EQ(with({"--target-error", "1e-6", "--time-limit", "1e-9"}), 4);
  EXPECT_EQ(replicas_in(folder / "a.h5"), 2U);
  EXPECT_EQ(with({"--target-error", "0.1", "--target-absolute", "0.1"}), 2);
}

TEST(ReplicaStudy, ErrorsLeaveNothingBehind) {
  const TemporaryFolder folder;
  const Measurement never = [](const Replica&) -> ReplicaRecord { throw std::logic_error("measured"); };
  const auto failing = [](const Replica&) -> ReplicaRecord { throw NumericalError("overflow"); };
  testing::internal::CaptureStderr();
  EXPECT_EQ(run({}, never), 2);
  EXPECT_EQ(run({"--output", folder / "a.h5", "--replicas", "0"}, never), 2);
  EXPECT_EQ(run({"--output", folder / "absent/a.h5"}, never), 2);
  EXPECT_EQ(run({"--output", folder / "a.h5"}, failing), 3);
  const std::string complaints = testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::count(complaints.begin(), complaints.end(), '\n'), 4) << complaints;  // one line each
  EXPECT_NE(complaints.find("example: numerical failure: overflow"), std::string::npos) << complaints;
  EXPECT_EQ(folder.names(), Names{});
}

// In a process of its own, because a signal once received is remembered.
TEST(ReplicaStudyDeathTest, SignalsEndTheRunWithACheckpoint) {
  for (const int number : {SIGINT, SIGTERM}) {
    const TemporaryFolder folder;
    const auto killed = [number](const Replica& replica) {
      if (replica.index == 3) ::raise(number);
      replica.heartbeat(0.5);
      return measure(replica);
    };
    EXPECT_EXIT(std::_Exit(run({"--output", folder / "a.h5", "--threads", "1"}, killed)),
                testing::ExitedWithCode(128 + number), "");
    EXPECT_EQ(folder.names(), Names{"a.h5.checkpoint"});
    EXPECT_EQ(Hdf5Reader(folder / "a.h5.checkpoint").counts("/replicas/index"),
              (std::vector<std::uint64_t>{0, 1, 2}));
  }
}

}  // namespace
