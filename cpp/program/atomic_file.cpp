#include "program/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <regex>

#include "program/errors.hpp"

namespace lorentz {
namespace {

/// Temporary file that commit() renames to the path and that is otherwise deleted. Throws UsageError.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& path)
      : path_(path), temporary_(fmt::format("{}.{}.tmp", path, ::getpid())) {
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

  void flush() {
    const bool flushed = ::fsync(descriptor_) == 0;
    const bool closed = ::close(descriptor_) == 0;
    descriptor_ = -1;
    if (!flushed || !closed) fail(std::strerror(errno), "Free space or choose another disk");
  }

  /// Call flush() before.
  void commit() {
    if (std::rename(temporary_.c_str(), path_.c_str()) != 0)
      fail(std::strerror(errno), "Free space or choose another disk");
    committed_ = true;
    flush_folder();
  }

 private:
  [[noreturn]] void fail(const std::string& why, const std::string& remedy) {
    const std::string message = fmt::format("'{}' cannot be written: {}. {}.", path_, why, remedy);
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = -1;
    ::unlink(temporary_.c_str());  // the destructor does not run when the constructor throws
    throw UsageError(message);
  }

  /// Makes the new name last through a power failure, where the file system can.
  void flush_folder() const {
    const std::string folder = std::filesystem::path(path_).parent_path();
    const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return;
    ::fsync(descriptor);
    ::close(descriptor);
  }

  std::string path_, temporary_;
  int descriptor_ = -1;
  bool committed_ = false;
};

/// Whether a name is that of a temporary file, whose process runs here no more.
bool is_leftover(const std::string& name) {
  static const std::regex pattern(R"(.*\.(\d{1,9})\.tmp)");
  std::smatch found;
  return std::regex_match(name, found, pattern) && ::kill(std::stoi(found[1]), 0) != 0 && errno == ESRCH;
}

/// Removes what killed processes left of this file, and of files that have its name and a suffix.
void remove_leftovers(const std::filesystem::path& path) {
  const std::string start = path.filename().string() + ".";
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename();
    if (name.starts_with(start) && is_leftover(name)) std::filesystem::remove(entry.path(), ignored);
  }
}

}  // namespace

void write_atomically(const std::string& path, std::span<const std::byte> content) {
  TemporaryFile file(path);
  file.write(content);
  file.flush();
  file.commit();
}

void write_atomically(const std::string& path, const std::string& content) {
  write_atomically(path, std::as_bytes(std::span(content)));
}

void require_writable(const std::string& path, std::size_t size) {
  remove_leftovers(path);
  TemporaryFile(path).reserve(size);
}

}  // namespace lorentz
