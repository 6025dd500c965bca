#pragma once

#include <string>

namespace lorentz {

/// Opens /dev/null in place of each standard stream that is closed, so that no other file gets its number and
/// its text. From then on, a write to a closed pipe or beyond the limit of a file's size fails, instead of
/// ending the process by a signal.
void secure_standard_streams();

/// Writes to standard output. Throws UsageError if it is closed or full.
void print(const std::string& text);

/// Writes to standard error. What it does not take is lost, because no message is worth a run.
void print_error(const std::string& text);

}  // namespace lorentz
