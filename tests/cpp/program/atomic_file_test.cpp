#include "program/atomic_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <span>
#include <string>

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

TEST(AtomicFile, WritesAndReplaces) {
  const TemporaryFolder folder;
  for (const std::string& content : {std::string(1 << 20, 'x'), std::string("a\0b", 3), std::string()}) {
    write(folder / "file", content);
    EXPECT_EQ(content_of(folder / "file"), content);
    EXPECT_EQ(folder.names(), Names{"file"});
  }
}

TEST(AtomicFile, RefusesMissingFoldersAndWhatIsNotARegularFile) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "folder");
  for (const std::string& path : {folder / "absent/file", folder / "folder"}) {
    EXPECT_NE(support::refusal([&] { require_writable(path); }), "");
    EXPECT_NE(support::refusal([&] { write(path, "content"); }), "");
  }
  EXPECT_EQ(folder.names(), Names{"folder"});
}

}  // namespace atomic_file_test
