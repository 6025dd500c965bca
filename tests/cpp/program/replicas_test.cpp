#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "program/errors.hpp"
#include "support/study.hpp"
#include "support/temporary_folder.hpp"

namespace replicas_test {

using namespace lorentz;
using namespace support;
using namespace std::chrono_literals;

TEST(Replicas, PassOnAnExceptionAndKeepWhatIsFinished) {
  for (const char* threads : {"1", "2", "5"}) {
    const TemporaryFolder folder;
    const auto failing = [](const Replica& replica) {
      if (replica.key.replica == 20) throw NumericalError("the twentieth");
      return measure(replica);
    };
    EXPECT_EQ(run({"--output", folder / "a.h5", "--threads", threads, "--replicas", "1000000"}, failing), 3);
    EXPECT_NE(complaints.find("the twentieth"), std::string::npos) << complaints;
  }
}

// The other replica never ends, so the test terminates only if its heartbeat throws.
TEST(Replicas, OneFailureStopsTheOthersAtTheirNextHeartbeat) {
  const TemporaryFolder folder;
  std::atomic<bool> other_runs{false};
  const auto fail_or_go_on = [&other_runs](const Replica& replica) -> double {
    while (replica.key.replica == 0 && !other_runs) std::this_thread::yield();
    if (replica.key.replica == 0) throw NumericalError("the first");
    for (other_runs = true;; std::this_thread::sleep_for(1ms)) replica.heartbeat(0.5);
  };
  EXPECT_EQ(run({"--output", folder / "a.h5", "--threads", "2", "--replicas", "2"}, fail_or_go_on), 3);
}

TEST(Replicas, BeginTheFirstTwoWhateverTheDeadline) {
  const TemporaryFolder folder;
  for (const char* threads : {"1", "2", "5"}) {
    EXPECT_EQ(run({"--output", folder / threads, "--threads", threads, "--time-limit", "1e-9"}), 4);
    EXPECT_EQ(replicas_in(folder / threads), 2U);
  }
}

TEST(Replicas, FinishTheLowestIndicesBeforeADeadline) {
  const TemporaryFolder folder;
  for (const char* threads : {"1", "5"}) {
    const auto slow = [](const Replica& replica) {
      std::this_thread::sleep_for(replica.key.replica % 2 == 0 ? 3ms : 1ms);
      return measure(replica);
    };
    EXPECT_EQ(run({"--output", folder / threads, "--threads", threads, "--time-limit", "0.03", "--replicas",
                   "1000000"},
                  slow),
              4);
    const std::uint64_t count = replicas_in(folder / threads);
    EXPECT_GE(count, 2U);
    EXPECT_LT(count, 1000000U);
    EXPECT_EQ(run({"--output", folder / "b.h5", "--overwrite", "--replicas", std::to_string(count)}), 0);
    EXPECT_EQ(Hdf5Reader(folder / threads).doubles("/results/value/mean"),
              Hdf5Reader(folder / "b.h5").doubles("/results/value/mean"));
  }
}

// Detected mistake: a tally that is never filled, which would be 0 in every result.
TEST(Replicas, WithATallyThatIsNeverFilledAreRefused) {
  struct Tallies : TallySchema {
    ScalarTally value = tally("value", "1", "A number");
    Tally forgotten = tally("forgotten", {numbered_axis("place", "Where", 3)}, "1", "Three numbers");
  };
  const Tallies tallies;
  TallySums sums(tallies);
  sums[tallies.value] = 1;
  try {
    sums.require_filled(tallies);
    FAIL();
  } catch (const std::logic_error& error) {
    EXPECT_NE(std::string(error.what()).find("forgotten"), std::string::npos) << error.what();
  }
  sums[tallies.forgotten.row(1)][0] = 2;
  EXPECT_NO_THROW(sums.require_filled(tallies));
}

}  // namespace replicas_test
