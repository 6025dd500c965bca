#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <string>
#include <thread>

#include "program/atomic_file.hpp"
#include "program/errors.hpp"
#include "program/hdf5_file.hpp"
#include "program/replica_file.hpp"
#include "support/refusal.hpp"
#include "support/temporary_folder.hpp"

namespace checkpoint_test {

using namespace lorentz;
using support::content_of;
using support::TemporaryFolder;

const std::string identity = "sigma = 0.5\nbuild_id = abc\n";

/// Tallies of a number and of a pair, as in some_replicas().
const std::vector<Description> tallies{{"a", "1", "A number"},
                                       {"b", "momentum", "A pair", {{"i", "1", "", {0, 1}}}}};
const ReplicaFile format{identity, tallies};

FinishedReplicas some_replicas() {
  return {{0, {{0.1, -0.0, 5e-324}, 3}}, {1, {{1e308, 2, 3}, 0}}, {1ULL << 40, {{-1, 1.0 / 3, 7}, ~0ULL}}};
}

/// A checkpoint file of the records of replicas.
struct Checkpoint {
  std::string path;

  explicit Checkpoint(std::string name) : path(std::move(name)) {}
  void save(const FinishedReplicas& finished) const { write_atomically(path, format.content(finished)); }
};

FinishedReplicas load(const Checkpoint& checkpoint) { return format.read(checkpoint.path).value(); }

TEST(Checkpoint, GivesBackWhatWasSaved) {
  const TemporaryFolder folder;
  const Checkpoint checkpoint(folder / "a.h5.checkpoint");
  checkpoint.save({{5, {{1.0, 2.0, 3.0}, 1}}});
  checkpoint.save(some_replicas());  // replaces the first checkpoint
  const FinishedReplicas loaded = load(checkpoint);
  const FinishedReplicas saved = some_replicas();
  ASSERT_EQ(loaded.size(), saved.size());
  for (const auto& [index, record] : saved) {
    ASSERT_TRUE(loaded.contains(index));
    EXPECT_EQ(loaded.at(index).values, record.values);
    EXPECT_EQ(loaded.at(index).events, record.events);
  }
  EXPECT_TRUE(std::signbit(loaded.at(0).values[1]));
}

TEST(Checkpoint, SaysWhatItsTalliesAre) {
  const TemporaryFolder folder;
  const Checkpoint checkpoint(folder / "a.h5.checkpoint");
  checkpoint.save(some_replicas());
  const Hdf5Reader file(checkpoint.path);
  EXPECT_TRUE(file.has_attribute("/tallies/b", "units", std::string("momentum")));
  EXPECT_TRUE(file.has_attribute("/tallies/b", "description", std::string("A pair")));
}

TEST(Checkpoint, OfAnotherRunHasNoReplicas) {
  const TemporaryFolder folder;
  const Checkpoint checkpoint(folder / "a.h5.checkpoint");
  checkpoint.save(some_replicas());
  for (const std::string& other : {std::string("sigma = 0.4\nbuild_id = abc\n"), identity + " ",
                                   identity.substr(0, identity.size() - 1), std::string()})
    EXPECT_FALSE((ReplicaFile{other, tallies}.read(checkpoint.path))) << other;
}

TEST(Checkpoint, AFlippedBitIsFound) {
  const TemporaryFolder folder;
  const Checkpoint checkpoint(folder / "a.h5.checkpoint");
  checkpoint.save(some_replicas());
  std::string content = content_of(checkpoint.path);
  for (std::size_t byte = 0; byte < content.size(); byte += 17) {
    const char right = content[byte];
    content[byte] = static_cast<char>(right ^ (1 << byte % 8));
    support::write_file(checkpoint.path, content);
    ASSERT_TRUE(support::refused_as("'" + checkpoint.path + "' cannot be resumed", [&] { load(checkpoint); }))
        << byte;
    content[byte] = right;
  }
  support::write_file(checkpoint.path, content);
  EXPECT_EQ(load(checkpoint).size(), 3U);
}

TEST(Checkpoint, TruncatedAndForeignFilesAreRefused) {
  const TemporaryFolder folder;
  const Checkpoint checkpoint(folder / "a.h5.checkpoint");
  checkpoint.save(some_replicas());
  const std::string whole = content_of(checkpoint.path);
  const auto expect_refusal = [&] {
    const std::string message = support::refusal([&] { load(checkpoint); });
    EXPECT_NE(message.find("'" + checkpoint.path + "'"), std::string::npos) << message;
    EXPECT_NE(message.find("Remove it"), std::string::npos) << message;
  };
  for (std::size_t size = 0; size < whole.size(); size += size < 64 ? 1 : 97) {
    support::write_file(checkpoint.path, whole.substr(0, size));
    expect_refusal();
  }
  for (const std::string& content :
       {whole.substr(0, whole.size() - 1), whole + " ", std::string(5000, '\0')}) {
    support::write_file(checkpoint.path, content);
    expect_refusal();
  }
}

TEST(Checkpoint, SurvivesAKillAtAnyMoment) {
  const TemporaryFolder folder;
  const Checkpoint checkpoint(folder / "a.h5.checkpoint");
  checkpoint.save(some_replicas());
  for (int round = 0; round < 30; ++round) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    // NOLINTNEXTLINE(bugprone-infinite-loop): until it is killed
    for (std::uint64_t index = 0; child == 0; ++index) checkpoint.save({{index, {{1.0, 2.0, 3.0}, 1}}});
    std::this_thread::sleep_for(std::chrono::microseconds(3000 + 700 * round));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    EXPECT_FALSE(load(checkpoint).empty()) << round;
  }
}

}  // namespace checkpoint_test
