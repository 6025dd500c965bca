#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <stdexcept>
#include <string>

#include "program/replica_file.hpp"
#include "support/study.hpp"
#include "support/temporary_folder.hpp"

namespace parts_test {

using namespace lorentz;
using namespace support;

double not_again(const Replica&) { throw std::logic_error("measured again"); }

/// A folder with a run in one piece and parts of the same run.
struct Parts : testing::Test {
  TemporaryFolder folder;

  Parts() {
    std::filesystem::create_directory(folder / "parts");
    EXPECT_EQ(run({"--output", folder / "whole.h5"}), 0);
  }

  int measure_part(const std::string& part, const MeasureValue& measurement = measure,
                   const Arguments& more = {}) const {
    Arguments arguments{"--part", part, "--output", folder / ("parts/" + part + ".part")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments, measurement);
  }
  int join_parts(const MeasureValue& measurement = not_again, const Arguments& more = {}) const {
    Arguments arguments{"--join", folder / "parts", "--output", folder / "joined.h5"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments, measurement);
  }
  bool joined_is_whole() const { return content_of(folder / "joined.h5") == content_of(folder / "whole.h5"); }
};

TEST_F(Parts, AreRangesOfTheReplicas) {
  for (const char* text : {"3", "-", "3-", "-3", "4-3", "0-16", "a-b", "0-1-2", "-1-2", "1.0-2"}) {
    EXPECT_EQ(run({"--part", text, "--output", folder / "a.part"}, not_again), 2) << text;
    EXPECT_NE(complaints.find("0-15"), std::string::npos) << complaints;
  }
}

TEST_F(Parts, JoinedAreTheBytesOfTheWholeRun) {
  for (const char* part : {"7-15", "0-0", "1-6"}) EXPECT_EQ(measure_part(part), 0);
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
  EXPECT_EQ(measured.size(), 13U);  // the rest
  EXPECT_TRUE(joined_is_whole());
}

TEST_F(Parts, MayOverlap) {
  EXPECT_EQ(measure_part("0-9"), 0);
  EXPECT_EQ(measure_part("5-15"), 0);
  EXPECT_EQ(join_parts(), 0);
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
  const Arguments output{"--output", folder / "a.part"};
  const auto measure_into = [&](Arguments arguments) {
    arguments.insert(arguments.end(), output.begin(), output.end());
    return run(arguments);
  };
  EXPECT_EQ(measure_into({"--part", "0-3"}), 0);
  EXPECT_EQ(measure_into({"--part", "0-3"}), 0);  // the same content
  EXPECT_EQ(measure_into({"--part", "0-4"}), 2);
  EXPECT_EQ(measure_into({"--part", "0-3", "--seed", "2"}), 2);
  EXPECT_NE(complaints.find("--overwrite"), std::string::npos) << complaints;
  EXPECT_EQ(measure_into({"--part", "0-4", "--overwrite"}), 0);
}

TEST_F(Parts, DamagedAreRefused) {
  EXPECT_EQ(measure_part("0-15"), 0);
  std::string content = content_of(folder / "parts/0-15.part");
  content[content.size() / 2] = static_cast<char>(content[content.size() / 2] ^ 1);
  write_file(folder / "parts/0-15.part", content);
  EXPECT_EQ(join_parts(), 2);
  EXPECT_NE(complaints.find("0-15.part"), std::string::npos) << complaints;
}

TEST_F(Parts, AreMissed) {
  EXPECT_EQ(join_parts(), 2);
  EXPECT_NE(complaints.find("--part"), std::string::npos) << complaints;
  std::filesystem::remove(folder / "parts");
  EXPECT_EQ(join_parts(), 2);
}

TEST_F(Parts, ExcludeWhatWouldChangeTheirNumber) {
  for (const Arguments& more : {Arguments{"--target-error", "0.1"},
                                {"--target-absolute", "0.1"},
                                {"--time-limit", "1"},
                                {"--join", folder / "parts"}})
    EXPECT_EQ(measure_part("0-3", not_again, more), 2) << more[0];
  EXPECT_EQ(run({"--part", "0-3", "--output", folder / "a.h5"}, not_again), 2);
  EXPECT_NE(complaints.find("must end with .part"), std::string::npos) << complaints;
}

}  // namespace parts_test
