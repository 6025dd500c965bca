#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <functional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "program/study.hpp"
#include "support/study.hpp"
#include "support/temporary_folder.hpp"

namespace estimation_test {

using namespace lorentz;
using namespace support;
using Names = std::set<std::string>;

/// A study whose estimate begins with an action.
Study study_estimating(const std::function<void()>& action) {
  Study study = study_of(measure);
  study.groups.front().statistics({{"more", "1", "Another"}}, [=](const Records&) {
    action();
    return Estimate{{1}, {0}};
  });
  study.remarks = [](const Results& results) {
    return std::vector<std::string>{"more is " + std::to_string(quantity_named(results, "more").mean[0])};
  };
  return study;
}

TEST(EstimationDeathTest, ASignalEndsTheRunWithACheckpoint) {
  for (const int number : {SIGINT, SIGTERM}) {
    const TemporaryFolder folder;
    const auto interrupted = [&] {
      return study_estimating([&] {
        ::raise(number);
        std::this_thread::sleep_for(std::chrono::minutes(5));
      });
    };
    EXPECT_EXIT(run_program({"--output", folder / "a.h5", "--progress", "log"}, interrupted),
                testing::ExitedWithCode(128 + number),
                "interrupted after 16 replicas; --resume continues from");
    EXPECT_EQ(Hdf5Reader(folder / "a.h5.checkpoint").counts("/replicas/index").size(), 16U);
    EXPECT_EQ(folder.names(), Names{"a.h5.checkpoint"});
  }
}

// Without the checkpoint the estimation would wait for ten seconds.
TEST(Estimation, WritesCheckpoints) {
  const TemporaryFolder folder;
  bool seen = false;
  const auto wait = [&] {
    for (int i = 0; !seen && i < 1000; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      seen = folder.names().contains("a.h5.checkpoint");
    }
  };
  EXPECT_EQ(run({"--output", folder / "a.h5", "--progress", "log", "--checkpoint-interval", "0.01"},
                [&] { return study_estimating(wait); }),
            0);
  EXPECT_TRUE(complaints.ends_with("example: more is 1.000000\n")) << complaints;
  EXPECT_TRUE(seen);
  EXPECT_EQ(folder.names(), (Names{"a.h5", "a.cost.json"}));
}

TEST(Estimation, ReportsItsFailure) {
  const TemporaryFolder folder;
  const auto failing = [] { return study_estimating([] { throw NumericalError("no estimate"); }); };
  EXPECT_EQ(run({"--output", folder / "a.h5"}, failing), 3);
  EXPECT_NE(complaints.find("numerical failure: no estimate"), std::string::npos) << complaints;
  EXPECT_EQ(folder.names(), Names{"a.h5.checkpoint"});
}

}  // namespace estimation_test
