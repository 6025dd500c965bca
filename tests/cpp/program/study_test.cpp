#include "program/study.hpp"

#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <new>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "program/stopping_rule.hpp"
#include "support/study.hpp"
#include "support/temporary_folder.hpp"

namespace study_test {

using namespace lorentz;
using namespace support;
using Names = std::set<std::string>;

TEST(Study, WritesEqualBytesForAnyNumberOfThreads) {
  for (const char* threads : {"1", "2", "5", "64"}) {
    const TemporaryFolder folder;
    EXPECT_EQ(run({"--output", folder / "a.h5", "--threads", "1"}), 0);
    EXPECT_EQ(run({"--output", folder / "b.h5", "--threads", threads}), 0);
    EXPECT_EQ(content_of(folder / "a.h5"), content_of(folder / "b.h5"));
    EXPECT_EQ(folder.names(), (Names{"a.h5", "a.cost.json", "b.h5", "b.cost.json"}));
    EXPECT_EQ(replicas_in(folder / "a.h5"), 16U);
  }
}

TEST(Study, EndsAtTheSameReplicaForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  for (const char* threads : {"1", "7"})
    EXPECT_EQ(run({"--output", folder / threads, "--target-error", "0.02", "--replicas", "3", "--threads",
                   threads}),
              0);
  EXPECT_EQ(content_of(folder / "1"), content_of(folder / "7"));
  EXPECT_GT(replicas_in(folder / "1"), 66U);
}

// Without the checkpoint the last replica would wait for ten seconds.
TEST(Study, WritesCheckpointsOnTheWay) {
  const TemporaryFolder folder;
  bool seen = false;
  const auto wait_for_checkpoint = [&](const Replica& replica) {
    for (int i = 0; replica.key.replica == 15 && !seen && i < 1000; ++i) {
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

TEST(Study, GoesOnWithoutACheckpointAndSaysSoOnce) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "a.h5.checkpoint");
  const auto slow = [](const Replica& replica) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return measure(replica);
  };
  EXPECT_EQ(run({"--output", folder / "a.h5", "--threads", "1", "--checkpoint-interval", "0.01"}, slow), 0);
  EXPECT_TRUE(complaints.starts_with("example: the run goes on without a checkpoint: ")) << complaints;
  EXPECT_EQ(complaints.find('\n'), complaints.size() - 1) << complaints;
  EXPECT_EQ(replicas_in(folder / "a.h5"), 16U);
}

TEST(Study, KeepsTheReplicasOfResultsThatCannotBeWritten) {
  const TemporaryFolder folder;
  const auto obstruct = [&](const Replica& replica) {
    if (replica.key.replica == 15) std::filesystem::create_directory(folder / "a.h5");
    return measure(replica);
  };
  EXPECT_EQ(run({"--output", folder / "a.h5", "--progress", "log"}, obstruct), 2);
  EXPECT_NE(complaints.find("--resume continues from"), std::string::npos) << complaints;
  EXPECT_EQ(folder.names(), (Names{"a.h5", "a.h5.checkpoint"}));
  std::filesystem::remove(folder / "a.h5");
  EXPECT_EQ(run({"--output", folder / "a.h5", "--resume"}, never), 0);
  EXPECT_EQ(run({"--output", folder / "b.h5"}), 0);
  EXPECT_EQ(content_of(folder / "a.h5"), content_of(folder / "b.h5"));
}

TEST(Study, KeepsTheReplicasIfMemoryRunsOut) {
  const TemporaryFolder folder;
  const auto greedy = [](const Replica& replica) {
    if (replica.key.replica == 5) throw std::bad_alloc();
    return measure(replica);
  };
  EXPECT_EQ(run({"--output", folder / "a.h5", "--threads", "1"}, greedy), 2);
  EXPECT_EQ(complaints.find('\n'), complaints.size() - 1) << complaints;
  EXPECT_EQ(Hdf5Reader(folder / "a.h5.checkpoint").counts("/replicas/index").size(), 5U);
}

TEST(Study, LosesNoReplicaInSilence) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "a.h5.checkpoint");
  EXPECT_EQ(run({"--output", folder / "a.h5"}, failing_at(5)), 3);
  EXPECT_NE(complaints.find("which are not saved: "), std::string::npos) << complaints;
}

TEST(Study, ResumesToEqualBytes) {
  const TemporaryFolder folder;
  const auto arguments = [&](const std::string& name, const Arguments& more = {}) {
    return with({"--threads", "1", "--output", folder / name}, more);
  };
  EXPECT_EQ(run(arguments("whole.h5")), 0);
  EXPECT_EQ(run(arguments("parts.h5"), failing_at(5)), 3);
  EXPECT_EQ(folder.names(), (Names{"whole.h5", "whole.cost.json", "parts.h5.checkpoint"}));
  EXPECT_EQ(run(arguments("parts.h5", {"--resume"}), failing_at(9)), 3);

  std::set<std::uint64_t> measured;
  const auto remember = [&](const Replica& replica) {
    measured.insert(replica.key.replica);
    return measure(replica);
  };
  EXPECT_EQ(run(arguments("parts.h5", {"--resume"}), remember), 0);
  EXPECT_EQ(measured, (std::set<std::uint64_t>{9, 10, 11, 12, 13, 14, 15}));
  EXPECT_EQ(content_of(folder / "parts.h5"), content_of(folder / "whole.h5"));
  EXPECT_FALSE(folder.names().contains("parts.h5.checkpoint"));
  EXPECT_EQ(run(arguments("fresh.h5", {"--resume"})), 0);  // there is no checkpoint
  EXPECT_EQ(content_of(folder / "fresh.h5"), content_of(folder / "whole.h5"));
}

TEST(Study, DiscardsACheckpointOnlyWithOverwrite) {
  const TemporaryFolder folder;
  const Arguments a{"--output", folder / "a.h5"};
  EXPECT_EQ(run(with(a, {"--threads", "1"}), failing_at(5)), 3);
  const std::string before = content_of(folder / "a.h5.checkpoint");
  const std::string foreign = "is of other options or another build";
  expect_refused_run(a, {"has 5 replicas of this run. Continue with --resume", "--overwrite"});
  expect_refused_run(with(a, {"--seed", "2"}), {foreign, "--overwrite"});
  expect_refused_run(with(a, {"--seed", "2", "--resume"}), {foreign, "--overwrite"});
  EXPECT_EQ(content_of(folder / "a.h5.checkpoint"), before);
  EXPECT_EQ(run(with(a, {"--resume", "--overwrite", "--seed", "2"})), 0);
  EXPECT_EQ(run({"--output", folder / "b.h5", "--seed", "2"}), 0);
  EXPECT_EQ(content_of(folder / "a.h5"), content_of(folder / "b.h5"));
  EXPECT_EQ(folder.names(), (Names{"a.h5", "a.cost.json", "b.h5", "b.cost.json"}));
  EXPECT_EQ(run({"--output", folder / "c.h5"}, failing_at(5)), 3);
  EXPECT_EQ(run({"--output", folder / "c.h5", "--overwrite"}), 0);
  EXPECT_FALSE(folder.names().contains("c.h5.checkpoint"));
}

TEST(Study, ReplacesNoResultOfOtherOptions) {
  const TemporaryFolder folder;
  const Arguments a{"--output", folder / "a.h5"};
  EXPECT_EQ(run(a), 0);
  // The existing result does not depend on the number of threads.
  EXPECT_EQ(run(with(a, {"--threads", "2"})), 0);
  const std::string before = content_of(folder / "a.h5");
  expect_refused_run(with(a, {"--seed", "2"}), {"another --seed", "--overwrite"});
  EXPECT_EQ(content_of(folder / "a.h5"), before);
  EXPECT_EQ(run(with(a, {"--seed", "2", "--overwrite"})), 0);
  expect_refused_run(a, {"another --seed", "--overwrite"});
  write_file(folder / "a.h5", "notes");
  expect_refused_run(a, {"not a complete HDF5 file"});
}

// 0.3 / sqrt(R) / 1.5 is far enough below 0.02 near R = 128; up to there a look follows every 8 replicas.
TEST(Study, StopsAtTheTargetErrorOnABatchBoundary) {
  const TemporaryFolder folder;
  const auto run_with = [&](const Arguments& more) {
    return run(with({"--overwrite", "--replicas", "8", "--output", folder / "a.h5"}, more));
  };
  const auto reached = [](std::uint64_t count, double mean, double error) {
    return StoppingRule::reached(count, error / mean / 0.02);
  };
  EXPECT_EQ(run_with({"--target-error", "0.02"}), 0);
  const std::uint64_t count = replicas_in(folder / "a.h5");
  EXPECT_EQ(count % 8, 0U);
  const Hdf5Reader file(folder / "a.h5");
  EXPECT_TRUE(reached(count, file.doubles("/results/value/mean")[0],
                      file.doubles("/results/value/standard_error")[0]));
  Records fewer(1);
  for (std::uint64_t index = 0; index < count - 8; ++index)
    fewer.append(std::vector{measure({{1, index}, {}})});
  const Quantity before = study_of(measure).groups[0].estimate(fewer)[0];
  EXPECT_FALSE(reached(count - 8, before.mean[0], before.standard_error[0]));

  EXPECT_EQ(run_with({"--target-error", "10"}), 0);  // a run has never fewer than 64 replicas
  EXPECT_EQ(replicas_in(folder / "a.h5"), 64U);
  EXPECT_EQ(run_with({"--target-error", "1e-6", "--time-limit", "1e-9"}), 4);
  EXPECT_EQ(replicas_in(folder / "a.h5"), 2U);
  EXPECT_EQ(run_with({"--target-error", "0.1", "--target-absolute", "0.1"}), 2);
}

TEST(Study, SaysWhereTheRunEnds) {
  const TemporaryFolder folder;
  EXPECT_EQ(run({"--target-error", "0.01", "--output", folder / "a.h5", "--progress", "log"}), 0);
  const std::string words = "the run ends after ";
  const std::size_t found = complaints.find(words);
  ASSERT_NE(found, std::string::npos) << complaints;
  std::istringstream rest(complaints.substr(found + words.size()));
  std::uint64_t low = 0, high = 0;
  std::string to;
  rest >> low >> to >> high;
  const std::uint64_t spent = replicas_in(folder / "a.h5");
  EXPECT_LE(low, spent) << complaints;
  EXPECT_GE(high, spent) << complaints;
}

TEST(Study, SaysHowUncertainErrorsFromFewReplicasAre) {
  const TemporaryFolder folder;
  const auto said = [&](const char* replicas, const char* progress) {
    EXPECT_EQ(
        run({"--overwrite", "--replicas", replicas, "--output", folder / "a.h5", "--progress", progress}), 0);
    return complaints;
  };
  const std::string warning = "example: standard errors from 9 replicas are uncertain by about 25 %\n";
  EXPECT_TRUE(said("9", "log").ends_with(warning)) << complaints;
  EXPECT_EQ(said("9", "none"), "");
  for (const char* replicas : {"1", "32"})
    EXPECT_EQ(said(replicas, "log").find("uncertain"), std::string::npos) << complaints;
}

// Looks take place only where an uninterrupted run has them: after 64, 72, 80, ... replicas.
TEST(Study, ResumesToTheSameBatchBoundary) {
  const TemporaryFolder folder;
  const auto run_to = [&](const std::string& name, const MeasureValue& measurement, const Arguments& more) {
    const Arguments target{"--threads", "1", "--replicas", "8", "--target-error", "0.02"};
    return run(with(with(target, {"--output", folder / name}), more), measurement);
  };
  EXPECT_EQ(run_to("whole.h5", measure, {}), 0);
  const std::uint64_t count = replicas_in(folder / "whole.h5");
  ASSERT_GT(count, 72U);
  EXPECT_EQ(run_to("parts.h5", failing_at(count - 1), {}), 3);
  EXPECT_EQ(run_to("parts.h5", measure, {"--resume"}), 0);
  EXPECT_EQ(content_of(folder / "parts.h5"), content_of(folder / "whole.h5"));
}

// The checkpoint has replicas finished out of order. The time limit leaves replica 2 missing, and those after
// it are not used.
TEST(Study, UsesTheLowestIndicesAtTheTimeLimitOfAResumedRun) {
  const TemporaryFolder folder;
  const auto late_failure = [](const Replica& replica) {
    if (replica.key.replica == 2) {
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
      throw NumericalError("a replica failed");
    }
    if (replica.key.replica == 8) std::this_thread::sleep_for(std::chrono::milliseconds(400));
    return measure(replica);
  };
  EXPECT_EQ(run({"--output", folder / "a.h5", "--threads", "2"}, late_failure), 3);
  EXPECT_EQ(run({"--output", folder / "a.h5", "--resume", "--time-limit", "1e-9"}), 4);
  EXPECT_EQ(replicas_in(folder / "a.h5"), 2U);
}

// A run without its target quantity is refused before anything is measured.
TEST(Study, WithoutItsTargetIsRefused) {
  const TemporaryFolder folder;
  const auto without_target = [] {
    Study study = study_of(never);
    study.target = "vale";
    return study;
  };
  EXPECT_EQ(run({"--output", folder / "a.h5"}, without_target), 5);
  EXPECT_NE(complaints.find("vale"), std::string::npos) << complaints;
}

}  // namespace study_test
