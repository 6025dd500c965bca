#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "program/replica_file.hpp"
#include "support/study.hpp"
#include "support/temporary_folder.hpp"

namespace parts_test {

using namespace lorentz;
using namespace support;

/// A folder with a run in one piece and parts of the same run.
struct Parts : testing::Test {
  TemporaryFolder folder;

  Parts() {
    std::filesystem::create_directory(folder / "parts");
    EXPECT_EQ(run({"--output", folder / "whole.h5"}), 0);
  }

  int measure_part(const std::string& part, const MeasureValue& measurement = measure,
                   const Arguments& more = {}) const {
    return run(with({"--part", part, "--output", folder / ("parts/" + part + ".part")}, more), measurement);
  }
  int join_parts(const MeasureValue& measurement = never, const Arguments& more = {}) const {
    return run(with({"--join", folder / "parts", "--output", folder / "joined.h5"}, more), measurement);
  }
  bool joined_is_whole() const { return content_of(folder / "joined.h5") == content_of(folder / "whole.h5"); }
};

TEST_F(Parts, AreRangesOfTheReplicas) {
  for (const char* text : {"3", "-", "3-", "-3", "4-3", "0-16", "a-b", "0-1-2", "-1-2", "1.0-2"}) {
    SCOPED_TRACE(text);
    expect_refused_run({"--part", text, "--output", folder / "a.part"}, {"0-15"});
  }
}

TEST_F(Parts, JoinedAreTheBytesOfTheWholeRun) {
  for (const char* part : {"7-15", "0-0", "1-9"}) EXPECT_EQ(measure_part(part), 0);
  EXPECT_EQ(join_parts(), 0);
  EXPECT_TRUE(joined_is_whole());
}

TEST_F(Parts, MeasureTheirReplicasAlone) {
  std::set<std::uint64_t> measured;
  const auto remember = [&](const Replica& replica) {
    measured.insert(replica.key.replica);
    return measure(replica);
  };
  EXPECT_EQ(measure_part("4-6", remember, {"--threads", "1"}), 0);
  EXPECT_EQ(measured, (std::set<std::uint64_t>{4, 5, 6}));
  measured.clear();
  EXPECT_EQ(join_parts(remember, {"--threads", "1"}), 0);
  EXPECT_EQ(measured.size(), 13U);  // only the replicas that no part has
  EXPECT_TRUE(joined_is_whole());
}

TEST_F(Parts, ResumeFromTheirCheckpoint) {
  EXPECT_EQ(measure_part("4-12", failing_at(9), {"--threads", "1"}), 3);
  EXPECT_FALSE(std::filesystem::exists(folder / "parts/4-12.part"));
  EXPECT_EQ(measure_part("4-12", failing_at(5), {"--resume"}), 0);
  EXPECT_EQ(measure_part("0-3"), 0);
  EXPECT_EQ(measure_part("13-15"), 0);
  EXPECT_EQ(join_parts(), 0);
  EXPECT_TRUE(joined_is_whole());
}

TEST_F(Parts, OfAnotherRunAreRefused) {
  EXPECT_EQ(measure_part("0-15", measure, {"--seed", "2"}), 0);
  EXPECT_EQ(join_parts(), 2);
  EXPECT_NE(complaints.find("0-15.part': it is of other options or another build"), std::string::npos)
      << complaints;
  EXPECT_FALSE(std::filesystem::exists(folder / "joined.h5"));
}

TEST_F(Parts, OfOtherOptionsOrReplicasAreKept) {
  const auto measure_into = [&](const Arguments& arguments) {
    return run(with(arguments, {"--output", folder / "a.part"}));
  };
  EXPECT_EQ(measure_into({"--part", "0-3"}), 0);
  EXPECT_EQ(measure_into({"--part", "0-3"}), 0);  // the file has the requested content already
  EXPECT_EQ(measure_into({"--part", "0-4"}), 2);
  EXPECT_EQ(measure_into({"--part", "0-3", "--seed", "2"}), 2);
  EXPECT_NE(complaints.find("--overwrite"), std::string::npos) << complaints;
  EXPECT_EQ(measure_into({"--part", "0-4", "--overwrite"}), 0);
}

TEST_F(Parts, AreMissed) {
  EXPECT_EQ(join_parts(), 2);
  EXPECT_NE(complaints.find("--part"), std::string::npos) << complaints;
  std::filesystem::remove(folder / "parts");
  EXPECT_EQ(join_parts(), 2);
  EXPECT_NE(complaints.find("No such file or directory"), std::string::npos) << complaints;
}

TEST_F(Parts, ExcludeWhatWouldChangeTheirNumber) {
  for (const Arguments& more : {Arguments{"--target-error", "0.1"},
                                {"--target-absolute", "0.1"},
                                {"--time-limit", "1"},
                                {"--join", folder / "parts"}})
    EXPECT_EQ(measure_part("0-3", never, more), 2) << more[0];
  expect_refused_run({"--part", "0-3", "--output", folder / "a.h5"}, {"must end with .part"});
}

}  // namespace parts_test
