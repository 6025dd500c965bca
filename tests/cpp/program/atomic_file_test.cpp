#include "program/atomic_file.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "program/errors.hpp"
#include "support/refusal.hpp"
#include "support/temporary_folder.hpp"

namespace atomic_file_test {

using namespace lorentz;
using support::content_of;
using support::TemporaryFolder;
using Names = std::set<std::string>;

void write(const std::string& path, const std::string& content) {
  write_atomically(path, std::as_bytes(std::span(content)));
}

/// Expects that writing and the check before it fail with a message that names the file and the remedy.
void expect_refused(const std::string& path, const std::string& remedy, std::size_t size = 100) {
  for (const bool ask_only : {true, false}) {
    try {
      ask_only ? require_writable(path) : write(path, std::string(size, 'x'));
      ADD_FAILURE() << path << " was written";
    } catch (const UsageError& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find("'" + path + "' cannot be written: "), std::string::npos) << message;
      EXPECT_NE(message.find(". " + remedy), std::string::npos) << message;
    }
  }
}

TEST(AtomicFile, WritesAndReplaces) {
  const TemporaryFolder folder;
  const std::string zeros("a\0b", 3);
  for (const std::string& content : {std::string("first"), std::string(1 << 20, 'x'), zeros, std::string()}) {
    write(folder / "file", content);
    EXPECT_EQ(content_of(folder / "file"), content);
    EXPECT_EQ(folder.names(), Names{"file"});
  }
}

// Files with other names are kept, as they may be the user's own.
TEST(AtomicFile, RemovesWhatAKilledProcessLeftAnHourAgo) {
  const TemporaryFolder folder;
  const Names others{"file",
                     "file.tmp",
                     "file.01234567.txt",
                     "file.0123456g.tmp",
                     "file.012345678.tmp",
                     "files.01234567.tmp"};
  const auto age = [&](const std::string& name, int minutes) {
    support::write_file(folder / name, "partial");
    std::filesystem::last_write_time(
        folder / name, std::filesystem::file_time_type::clock::now() - std::chrono::minutes(minutes));
  };
  for (const std::string& name : others) age(name, 90);
  age("file.01234567.tmp", 90);
  age("file.89abcdef.tmp", 30);  // of a process that may still write it
  require_writable(folder / "file");
  Names left = others;
  left.insert("file.89abcdef.tmp");
  EXPECT_EQ(folder.names(), left);
}

TEST(AtomicFile, IsWrittenByProcessesAtOneTime) {
  const TemporaryFolder folder;
  std::vector<pid_t> children;
  for (int i = 0; i < 6; ++i) {
    children.push_back(::fork());
    if (children.back() != 0) continue;
    try {
      for (int round = 0; round < 20; ++round) {
        require_writable(folder / "file");
        write(folder / "file", std::string(100'000, 'x'));
      }
    } catch (...) {
      std::_Exit(1);
    }
    std::_Exit(0);
  }
  for (const pid_t child : children) {
    int status = 1;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(folder.names(), Names{"file"});
  EXPECT_EQ(content_of(folder / "file"), std::string(100'000, 'x'));
}

// A folder cannot be read as a file.
TEST(AtomicFile, SaysWhyAFileCannotBeRead) {
  const TemporaryFolder folder;
  const auto message = [](const std::string& path) {
    return support::refusal([&] { (void)read_whole(path); });
  };
  EXPECT_EQ(
      message(folder / "absent"),
      "'" + (folder / "absent") +
          "' cannot be read: No such file or directory. Its content may be intact: make it readable, or "
          "name another file.");
  EXPECT_NE(message(folder.path()).find("Is a directory"), std::string::npos);
}

TEST(AtomicFile, AskingLeavesNothingBehindAndTouchesNothing) {
  const TemporaryFolder folder;
  require_writable(folder / "file");
  EXPECT_EQ(folder.names(), Names{});
  write(folder / "file", std::string("content"));
  require_writable(folder / "file");
  EXPECT_EQ(folder.names(), Names{"file"});
  EXPECT_EQ(content_of(folder / "file"), "content");
}

TEST(AtomicFile, RefusesMissingFoldersAndWhatIsNotARegularFile) {
  const TemporaryFolder folder;
  write(folder / "file", std::string("content"));
  std::filesystem::create_directory(folder / "folder");
  for (const std::string& path : {folder / "absent/file", folder / "file/below", std::string("/proc/file")})
    expect_refused(path, "Name a file in an existing folder");
  for (const std::string& path : {folder / "folder", std::string("/dev/full")})
    expect_refused(path, "Name a file that may be replaced");
  EXPECT_EQ(folder.names(), (Names{"file", "folder"}));
}

/// Limits the size of files, so that writing fails halfway as on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t size) : handler_(::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{size, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    ::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST(AtomicFile, KeepsTheOldFileWhenTheDiskIsFull) {
  const TemporaryFolder folder;
  write(folder / "file", std::string("content"));
  {
    const FileSizeLimit limit(1 << 16);
    expect_refused(folder / "file", "Free space", 1 << 17);
    expect_refused(folder / "other", "Free space", 1 << 17);
    EXPECT_NO_THROW(write(folder / "small", std::string("fits")));
  }
  EXPECT_EQ(folder.names(), (Names{"file", "small"}));
  EXPECT_EQ(content_of(folder / "file"), "content");
}

}  // namespace atomic_file_test
