#include "program/replicas.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "program/errors.hpp"

namespace {

using namespace lorentz;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

ReplicaRun run_of(std::uint64_t end, unsigned threads) {
  return {1,
          0,
          end,
          threads,
          Clock::time_point::max(),
          [](double, const FinishedReplicas&) {},
          [](const std::string& line) { ADD_FAILURE() << line; },
          [](int, const FinishedReplicas&) { ADD_FAILURE() << "abandoned"; }};
}

ReplicaRecord record_of(std::uint64_t index) {
  return {{static_cast<double>(index), 1.0 / static_cast<double>(index + 1)}, 10 * index};
}

ReplicaRecord measure(const Replica& replica) { return record_of(replica.key.replica); }

void expect_records(const FinishedReplicas& finished, std::uint64_t count) {
  ASSERT_EQ(finished.size(), count);
  for (std::uint64_t index = 0; index < count; ++index) {
    ASSERT_TRUE(finished.contains(index)) << index;
    EXPECT_EQ(finished.at(index).values, record_of(index).values);
    EXPECT_EQ(finished.at(index).events, record_of(index).events);
  }
}

TEST(Replicas, DoNotDependOnTheNumberOfThreads) {
  for (const unsigned threads : {1U, 2U, 5U, 64U}) {
    FinishedReplicas finished;
    run_replicas(run_of(40, threads), measure, finished);
    expect_records(finished, 40);
  }
}

TEST(Replicas, MeasureOnlyWhatIsMissing) {
  for (const unsigned threads : {1U, 2U, 5U}) {
    FinishedReplicas finished;
    for (const std::uint64_t index : {0, 1, 7, 39}) finished[index] = record_of(index);
    std::mutex mutex;
    std::multiset<std::uint64_t> measured;
    run_replicas(
        run_of(40, threads),
        [&](const Replica& replica) {
          const std::lock_guard lock(mutex);
          measured.insert(replica.key.replica);
          return measure(replica);
        },
        finished);
    expect_records(finished, 40);
    EXPECT_EQ(measured.size(), 36U);
    for (const std::uint64_t index : {0, 1, 7, 39}) EXPECT_EQ(measured.count(index), 0U);
  }
}

TEST(Replicas, NothingToDoIsNoWork) {
  FinishedReplicas finished{{0, record_of(0)}};
  run_replicas(
      run_of(1, 3), [](const Replica&) -> ReplicaRecord { throw std::logic_error("called"); }, finished);
  expect_records(finished, 1);
}

TEST(Replicas, PassOnAnExceptionAndKeepWhatIsFinished) {
  for (const unsigned threads : {1U, 2U, 5U}) {
    FinishedReplicas finished;
    const auto failing = [](const Replica& replica) {
      if (replica.key.replica == 20) throw NumericalError("the twentieth");
      return measure(replica);
    };
    try {
      run_replicas(run_of(1000000, threads), failing, finished);
      ADD_FAILURE() << "no exception";
    } catch (const NumericalError& error) {
      EXPECT_STREQ(error.what(), "the twentieth");
    }
    EXPECT_FALSE(finished.contains(20));
    EXPECT_GE(finished.size(), 20U);  // started before, and not stopped by a heartbeat
    EXPECT_LT(finished.size(), 1000000U);
    for (const auto& [index, record] : finished) EXPECT_EQ(record.values, record_of(index).values);
    if (threads == 1) expect_records(finished, 20);
  }
}

// The other replica never ends, so the test terminates only if its heartbeat throws.
TEST(Replicas, OneFailureStopsTheOthersAtTheirNextHeartbeat) {
  FinishedReplicas finished;
  std::atomic<bool> other_runs{false};
  const auto fail_or_go_on = [&other_runs](const Replica& replica) -> ReplicaRecord {
    while (replica.key.replica == 0 && !other_runs) std::this_thread::yield();
    if (replica.key.replica == 0) throw NumericalError("the first");
    for (other_runs = true;; std::this_thread::sleep_for(1ms)) replica.heartbeat(0.5);
  };
  EXPECT_THROW(run_replicas(run_of(2, 2), fail_or_go_on, finished), NumericalError);
  EXPECT_TRUE(finished.empty());
}

TEST(Replicas, BeginTheFirstTwoWhateverTheDeadline) {
  for (const unsigned threads : {1U, 2U, 5U}) {
    ReplicaRun run = run_of(40, threads);
    run.deadline = Clock::now() - 1s;
    FinishedReplicas finished;
    run_replicas(run, measure, finished);
    expect_records(finished, 2);
    run_replicas(run, measure, finished);  // and no more than these
    expect_records(finished, 2);
  }
}

TEST(Replicas, FinishTheLowestIndicesBeforeADeadline) {
  for (const unsigned threads : {1U, 5U}) {
    ReplicaRun run = run_of(1000000, threads);
    run.deadline = Clock::now() + 30ms;
    FinishedReplicas finished;
    const auto slow = [](const Replica& replica) {
      std::this_thread::sleep_for(replica.key.replica % 2 == 0 ? 3ms : 1ms);
      return measure(replica);
    };
    run_replicas(run, slow, finished);
    EXPECT_GE(finished.size(), 2U);
    EXPECT_LT(finished.size(), 1000000U);
    expect_records(finished, finished.size());
  }
}

// A failing report, as from a checkpoint on a full disk, ends the run at once.
TEST(Replicas, AFailingReportStopsTheRun) {
  ReplicaRun run = run_of(10000, 2);
  run.report = [](double, const FinishedReplicas&) { throw UsageError("disk full"); };
  FinishedReplicas finished;
  const auto slow = [](const Replica& replica) {
    std::this_thread::sleep_for(1ms);
    return measure(replica);
  };
  EXPECT_THROW(run_replicas(run, slow, finished), UsageError);
  EXPECT_LT(finished.size(), 5000U);
}

// The last replica runs until a report has counted its quarter, or for ten seconds.
TEST(Replicas, ReportWhatIsDoneInParts) {
  std::atomic<bool> reported{false};
  ReplicaRun run = run_of(3, 1);
  run.report = [&reported](double done, const FinishedReplicas& finished) {
    if (done == 2.25 && finished.size() == 2) reported = true;
  };
  FinishedReplicas finished;
  const auto wait_for_report = [&reported](const Replica& replica) {
    if (replica.key.replica == 2) {
      replica.heartbeat(0.25);
      for (int i = 0; i < 10000 && !reported; ++i) std::this_thread::sleep_for(1ms);
    }
    return measure(replica);
  };
  run_replicas(run, wait_for_report, finished);
  EXPECT_TRUE(reported);
  expect_records(finished, 3);
}

}  // namespace
