#include "program/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "program/errors.hpp"

namespace lorentz {
namespace {

/// Temporary file that commit() renames to the path and that is otherwise deleted. Throws UsageError.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& path) : path_(path), temporary_(path + ".tmp") {
    struct stat status{};
    if (::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode))
      fail("it exists and is not a regular file", "Name a file that may be replaced");
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail(std::strerror(errno), "Name a file in an existing folder that you may write");
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!committed_) ::unlink(temporary_.c_str());
  }

  void write(std::span<const std::byte> content) {
    while (!content.empty()) {
      const ssize_t written = ::write(descriptor_, content.data(), content.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail(std::strerror(errno), "Free space or choose another disk");
      content = content.subspan(static_cast<std::size_t>(written));
    }
  }

  void reserve(std::size_t size) {
    const int error = ::posix_fallocate(descriptor_, 0, static_cast<off_t>(size));
    if (error != 0) fail(std::strerror(error), "Free space or choose another disk");
  }

  void commit() {
    if (::fsync(descriptor_) != 0 || std::rename(temporary_.c_str(), path_.c_str()) != 0)
      fail(std::strerror(errno), "Free space or choose another disk");
    committed_ = true;
    // Makes the new name last through a power failure, where the file system can.
    const std::string folder = std::filesystem::path(path_).parent_path();
    const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return;
    ::fsync(descriptor);
    ::close(descriptor);
  }

 private:
  [[noreturn]] void fail(const std::string& why, const std::string& remedy) {
    throw UsageError(fmt::format("'{}' cannot be written: {}. {}.", path_, why, remedy));
  }

  std::string path_, temporary_;
  int descriptor_ = -1;
  bool committed_ = false;
};

}  // namespace

void write_atomically(const std::string& path, std::span<const std::byte> content) {
  TemporaryFile file(path);
  file.write(content);
  file.commit();
}

void require_writable(const std::string& path, std::size_t size) { TemporaryFile(path).reserve(size); }

}  // namespace lorentz
