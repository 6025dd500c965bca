#include "program/atomic_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <random>
#include <system_error>
#include <vector>

#include "program/errors.hpp"

namespace lorentz {
namespace {

namespace fs = std::filesystem;

void refuse(const std::string& path, const char* why, const char* remedy) {
  throw UsageError(fmt::format("'{}' cannot be written: {}. {}.", path, why, remedy));
}

/// Writes a temporary file to the disk and returns its name.
std::string write_beside(const std::string& path, std::span<const std::byte> content) {
  std::error_code unknown;
  if (const fs::file_status status = fs::status(path, unknown);
      fs::exists(status) && !fs::is_regular_file(status))
    refuse(path, "it exists and is not a regular file", "Name a file that may be replaced");
  const std::string temporary = fmt::format("{}.{:08x}.tmp", path, std::random_device{}());
  std::FILE* const file = std::fopen(temporary.c_str(), "wbx");
  if (!file) refuse(path, std::strerror(errno), "Name a file in an existing folder that you may write");
  const bool written = std::fwrite(content.data(), 1, content.size(), file) == content.size() &&
                       std::fflush(file) == 0 && ::fsync(::fileno(file)) == 0;
  const int error = errno;
  std::fclose(file);
  if (!written) {
    fs::remove(temporary, unknown);
    refuse(path, std::strerror(error), "Free space or choose another disk");
  }
  return temporary;
}

}  // namespace

void write_atomically(const std::string& path, std::span<const std::byte> content) {
  const std::string temporary = write_beside(path, content);
  std::error_code error, unknown;
  fs::rename(temporary, path, error);
  if (!error) return;
  fs::remove(temporary, unknown);
  refuse(path, error.message().c_str(), "Name a file in a folder that you may write");
}

void require_writable(const std::string& path) {
  constexpr std::size_t usual_size = 1 << 18;  // bytes
  fs::remove(write_beside(path, std::vector<std::byte>(usual_size)));
}

}  // namespace lorentz
