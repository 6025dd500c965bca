#include "program/checkpoint.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "program/errors.hpp"
#include "support/temporary_folder.hpp"

namespace {

using namespace lorentz;
using support::content_of;
using support::TemporaryFolder;

const std::string identity = "sigma = 0.5\nbuild_id = abc\n";

/// A number and a pair, as in some_replicas().
const std::vector<Description> tallies{{"a", "1", "A number"},
                                       {"b", "1", "A pair", {{"i", "1", "", {0, 1}}}}};

FinishedReplicas some_replicas() {
  return {{0, {{0.1, -0.0, 5e-324}, 3}}, {1, {{1e308, 2, 3}, 0}}, {1ULL << 40, {{-1, 1.0 / 3, 7}, ~0ULL}}};
}

TEST(Checkpoint, GivesBackWhatWasSaved) {
  const TemporaryFolder folder;
  const Checkpoint checkpoint(folder / "a.h5", identity, tallies);
  EXPECT_EQ(checkpoint.path(), folder / "a.h5.checkpoint");
  checkpoint.save({{5, {{1.0, 2.0, 3.0}, 1}}});
  checkpoint.save(some_replicas());  // replaces the first
  const FinishedReplicas loaded = checkpoint.load();
  const FinishedReplicas saved = some_replicas();
  ASSERT_EQ(loaded.size(), saved.size());
  for (const auto& [index, record] : saved) {
    ASSERT_TRUE(loaded.contains(index));
    EXPECT_EQ(loaded.at(index).values, record.values);
    EXPECT_EQ(loaded.at(index).events, record.events);
  }
  EXPECT_TRUE(std::signbit(loaded.at(0).values[1]));
}

TEST(Checkpoint, IsEmptyWithoutAFile) {
  const TemporaryFolder folder;
  const Checkpoint checkpoint(folder / "a.h5", identity, tallies);
  EXPECT_TRUE(checkpoint.load().empty());
  checkpoint.save({});  // no finished replica, no file
  EXPECT_TRUE(folder.names().empty());
  EXPECT_NO_THROW(checkpoint.remove());
}

TEST(Checkpoint, IsRemoved) {
  const TemporaryFolder folder;
  const Checkpoint checkpoint(folder / "a.h5", identity, tallies);
  checkpoint.save(some_replicas());
  EXPECT_FALSE(folder.names().empty());
  checkpoint.remove();
  EXPECT_TRUE(folder.names().empty());
}

/// Loading fails with a message that names the file and states what to do.
void expect_refused(const Checkpoint& checkpoint, const std::string& case_name) {
  try {
    (void)checkpoint.load();
    ADD_FAILURE() << case_name << " was accepted";
  } catch (const UsageError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find(checkpoint.path()), std::string::npos) << message;
    EXPECT_NE(message.find("Remove it"), std::string::npos) << message;
  }
}

TEST(Checkpoint, OfAnotherIdentityIsRefused) {
  const TemporaryFolder folder;
  Checkpoint(folder / "a.h5", identity, tallies).save(some_replicas());
  for (const std::string& other : {std::string("sigma = 0.4\nbuild_id = abc\n"), identity + " ",
                                   identity.substr(0, identity.size() - 1), std::string()})
    expect_refused(Checkpoint(folder / "a.h5", other, tallies), other);
}

TEST(Checkpoint, TruncatedFilesAreRefused) {
  const TemporaryFolder folder;
  const Checkpoint checkpoint(folder / "a.h5", identity, tallies);
  checkpoint.save(some_replicas());
  const std::string whole = content_of(checkpoint.path());
  for (std::size_t size = 0; size < whole.size(); size += size < 64 ? 1 : 97) {
    support::write_file(checkpoint.path(), whole.substr(0, size));
    expect_refused(checkpoint, std::to_string(size) + " bytes");
  }
  support::write_file(checkpoint.path(), whole.substr(0, whole.size() - 1));
  expect_refused(checkpoint, "one byte short");
  support::write_file(checkpoint.path(), whole);
  EXPECT_EQ(checkpoint.load().size(), 3U);
}

}  // namespace
