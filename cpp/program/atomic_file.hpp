#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace lorentz {

/// Writes a file atomically: under a temporary name in the same folder, flushed to the disk, then renamed.
/// Throws UsageError, and leaves no new file, if the folder is not writable or the disk is full.
void write_atomically(const std::string& path, std::span<const std::byte> content);
void write_atomically(const std::string& path, const std::string& content);

/// Throws UsageError if write_atomically(path, ...) could not write `size` bytes now; leaves no file, and
/// removes temporary ones of processes that were killed. Called before a long run, so that the run does not
/// fail at its end.
void require_writable(const std::string& path, std::size_t size);

}  // namespace lorentz
