#include "program/atomic_file.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <vector>

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

/// Expects that writing and the check before it fail with a message that names the file.
void expect_refused(const std::string& path) {
  for (const std::string& message :
       {support::refusal([&] { require_writable(path); }), support::refusal([&] { write(path, "content"); })})
    EXPECT_NE(message.find("'" + path + "'"), std::string::npos) << message;
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

TEST(AtomicFile, WrittenBySeveralProcesses) {
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

TEST(AtomicFile, RefusesMissingFoldersAndWhatIsNotARegularFile) {
  const TemporaryFolder folder;
  write(folder / "file", std::string("content"));
  std::filesystem::create_directory(folder / "folder");
  for (const std::string& path : {folder / "absent/file", folder / "file/below", std::string("/proc/file"),
                                  folder / "folder", std::string("/dev/full")})
    expect_refused(path);
  EXPECT_EQ(folder.names(), (Names{"file", "folder"}));
}

}  // namespace atomic_file_test
