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

  void expect_refused(const std::string& content) const {
    support::write_file(checkpoint.path, content);
    const std::string message = support::refusal([&] { (void)checkpoint.load(); });
    EXPECT_NE(message.find("'" + checkpoint.path + "'"), std::string::npos) << message;
  }
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
}

TEST_F(CheckpointTest, OfAnotherRunHasNoReplicas) {
  checkpoint.save(saved);
  const std::string identity = checkpoint.identity;
  for (const std::string& other : {std::string("sigma = 0.4\nsource_hash = abc\n"), identity + " ",
                                   identity.substr(0, identity.size() - 1), std::string()}) {
    checkpoint.identity = other;
    EXPECT_TRUE(checkpoint.load().empty()) << other;
  }
}

TEST_F(CheckpointTest, RefusesAnotherValue) {
  checkpoint.save(saved);
  const std::string whole = content_of(checkpoint.path);
  const double value = 1.0 / 3;
  const std::size_t at = whole.find(std::string(reinterpret_cast<const char*>(&value), sizeof value));
  ASSERT_NE(at, std::string::npos);
  for (std::size_t byte = at; byte < at + sizeof value; ++byte) {
    std::string damaged = whole;
    damaged[byte] = static_cast<char>(damaged[byte] ^ 1);
    expect_refused(damaged);
  }
  support::write_file(checkpoint.path, whole);
  EXPECT_EQ(checkpoint.load().size(), 3U);
}

TEST_F(CheckpointTest, RefusesTruncatedAndForeignFiles) {
  checkpoint.save(saved);
  const std::string whole = content_of(checkpoint.path);
  for (std::size_t size = 0; size < whole.size(); size += size < 64 ? 8 : 97)
    expect_refused(whole.substr(0, size));
  expect_refused(std::string(5000, '\0'));
}

}  // namespace checkpoint_test
