#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "program/record_file.hpp"

namespace lorentz {

/// Consecutive replicas of a run, which another process, on another machine perhaps, measures apart. The
/// record of a replica depends on its index alone, so that the parts joined are the run.
struct Part {
  static constexpr auto suffix = ".part";  // of the file with its records

  std::uint64_t first, last;

  std::uint64_t size() const { return last - first + 1; }

  /// Of "24-47". Throws UsageError if the text is none, or not among so many replicas.
  static Part from(const std::string& text, std::uint64_t replicas);
};

/// The replicas of all parts in a folder. Throws UsageError if there is none, or one is damaged or of another
/// run.
FinishedReplicas join(const std::string& folder, const RecordFile& format);

}  // namespace lorentz
