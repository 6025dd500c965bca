#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace lorentz {

/// Writes a file whole or not at all: to a temporary name in the same folder, flushed to the disk,
/// then renamed. Throws UsageError, and leaves neither file, when the folder cannot be written or
/// the disk is full.
void write_atomically(const std::string& path, std::span<const std::byte> content);
void write_atomically(const std::string& path, const std::string& content);

/// Throws UsageError if write_atomically(path, ...) could not write `size` bytes now; leaves nothing
/// behind. Asked before a long run, not after it.
void require_writable(const std::string& path, std::size_t size);

}  // namespace lorentz
