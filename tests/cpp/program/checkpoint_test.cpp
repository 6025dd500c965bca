#include "program/checkpoint.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "program/errors.hpp"
#include "support/refusal.hpp"
#include "support/temporary_folder.hpp"

namespace checkpoint_test {

using namespace lorentz;
using support::content_of;

struct CheckpointTest : testing::Test {
  support::TemporaryFolder folder;
  Checkpoint checkpoint{folder / "a.h5.checkpoint", "sigma = 0.5\nsource_hash = abc\n"};
  FinishedReplicas saved{
      {0, {{0.1, -0.0, 5e-324}, 3}}, {1, {{1e308, 2, 3}, 0}}, {1ULL << 40, {{-1, 1.0 / 3, 7}, ~0ULL}}};
};

TEST_F(CheckpointTest, LoadsWhatWasSaved) {
  checkpoint.save({{5, {{1.0, 2.0, 3.0}, 1}}});
  checkpoint.save(saved);  // replaces the first checkpoint
  const FinishedReplicas loaded = checkpoint.load();
  ASSERT_EQ(loaded.size(), saved.size());
  for (const auto& [index, record] : saved) {
    ASSERT_TRUE(loaded.contains(index));
    EXPECT_EQ(loaded.at(index).values, record.values);
    EXPECT_EQ(loaded.at(index).events, record.events);
  }
  EXPECT_TRUE(std::signbit(loaded.at(0).values[1]));
  const double first = checkpoint.former_seconds;  // the CPU time of this process when it saved
  EXPECT_GT(first, 0);
  checkpoint.save(loaded);
  (void)checkpoint.load();
  EXPECT_GE(checkpoint.former_seconds, 2 * first);
}

TEST_F(CheckpointTest, RefusesDamagedFiles) {
  checkpoint.save(saved);
  const std::string whole = content_of(checkpoint.path);
  const double value = 1.0 / 3;
  const std::size_t at = whole.find(std::string(reinterpret_cast<const char*>(&value), sizeof value));
  ASSERT_NE(at, std::string::npos);
  std::string another_value = whole;
  another_value[at] = static_cast<char>(another_value[at] ^ 1);
  for (const std::string& damaged : {another_value, whole.substr(0, whole.size() / 2), std::string()}) {
    support::write_file(checkpoint.path, damaged);
    const std::string message = support::refusal([&] { (void)checkpoint.load(); });
    EXPECT_NE(message.find("'" + checkpoint.path + "'"), std::string::npos) << message;
  }
}

}  // namespace checkpoint_test
