#include "program/program.hpp"

#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <cmath>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "support/study.hpp"
#include "support/temporary_folder.hpp"

namespace program_test {

using namespace lorentz;
using namespace support;
using Names = std::set<std::string>;

TEST(Program, ErrorsLeaveNothingBehind) {
  const TemporaryFolder folder;
  const auto failing = [](const Replica&) -> double { throw NumericalError("overflow"); };
  expect_refused_run({}, {"--output"});
  expect_refused_run({"--output", folder / "a.h5", "--replicas", "0"}, {"--replicas"});
  expect_refused_run({"--output", folder / "absent/a.h5"}, {"absent/a.h5"});
  EXPECT_EQ(run({"--output", folder / "a.h5"}, failing), 3);
  EXPECT_EQ(complaints, "example: numerical failure: overflow\n");
  EXPECT_EQ(run({"--output", folder / "a.h5"}, never), 5);
  EXPECT_TRUE(complaints.starts_with("example: internal error: measured")) << complaints;
  EXPECT_EQ(complaints.find('\n'), complaints.size() - 1) << complaints;
  EXPECT_EQ(folder.names(), Names{});
}

// The program runs in a separate process, which a signal ends. No replica has a heartbeat: the first three
// are too short, and the fourth is interrupted during its setup.
TEST(ProgramDeathTest, SignalsEndTheRunWithACheckpoint) {
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
    const TemporaryFolder folder;
    const auto killed = [number](const Replica& replica) {
      if (replica.key.replica == 3) {
        ::raise(number);
        std::this_thread::sleep_for(std::chrono::minutes(5));
      }
      return measure(replica);
    };
    const auto run = [&] {
      ::signal(SIGHUP, SIG_DFL);  // under nohup these tests would ignore it
      run_program({"--output", folder / "a.h5", "--threads", "1"}, [&] { return study_of(killed); });
    };
    EXPECT_EXIT(run(), testing::ExitedWithCode(128 + number), "");
    EXPECT_EQ(folder.names(), Names{"a.h5.checkpoint"});
    EXPECT_EQ(Hdf5Reader(folder / "a.h5.checkpoint").counts("/replicas/index"),
              (std::vector<std::uint64_t>{0, 1, 2}));
  }
}

TEST(Program, PrintsTheErrorInBrackets) {
  EXPECT_EQ(with_error(0.32080091, 0.0045), "0.3208(45)");
  EXPECT_EQ(with_error(-0.32080091, 0.00996), "-0.321(10)");
  EXPECT_EQ(with_error(12.3, 1.5), "12.3(1.5)");
  EXPECT_EQ(with_error(12.3, 0.996), "12.3(1.0)");
  EXPECT_EQ(with_error(41234.5, 1234), "41234(1200)");
  EXPECT_EQ(with_error(4.1234e-9, 1.2e-11), "4.123(12)e-9");
  EXPECT_EQ(with_error(0.5, 0), "0.5");
  EXPECT_EQ(with_error(0.5, std::nan("")), "0.5");
}

}  // namespace program_test
