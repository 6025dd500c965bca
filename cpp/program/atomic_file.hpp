#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace lorentz {

/// Writes a file atomically: under a temporary name in the same folder, flushed to the disk, then renamed.
/// The names of two processes differ. Throws UsageError, and leaves the file as it was, if the folder is not
/// writable or the disk is full.
void write_atomically(const std::string& path, std::span<const std::byte> content);

/// Throws UsageError if write_atomically(path, ...) could not write a result of usual size now. Called before
/// a long run, so that the run does not fail at its end.
void require_writable(const std::string& path);

}  // namespace lorentz
