#include "program/parts.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "program/errors.hpp"
#include "program/number_text.hpp"

namespace lorentz {

Part Part::from(const std::string& text, std::uint64_t replicas) {
  Part part{};
  const std::size_t dash = text.find('-');
  const Range<std::uint64_t> range{0, replicas - 1};
  if (dash == std::string::npos || !read_number(text.substr(0, dash), range, part.first) ||
      !read_number(text.substr(dash + 1), range, part.last) || part.first > part.last)
    throw UsageError(fmt::format(
        "--part {} is no range of replicas. Give the first and the last, as 0-{}, of a run that has {}.",
        text, replicas - 1, replicas));
  return part;
}

FinishedReplicas join(const std::string& folder, const RecordFile& format) {
  std::error_code unreadable;
  FinishedReplicas joined;
  for (const auto& entry : std::filesystem::directory_iterator(folder, unreadable))
    if (entry.path().extension() == Part::suffix) joined.merge(format.read(entry.path().string()));
  if (unreadable) throw UsageError(fmt::format("--join '{}': {}", folder, unreadable.message()));
  if (joined.empty())
    throw UsageError(
        fmt::format("--join '{}': no file there ends with {}. Measure parts into that folder with --part.",
                    folder, Part::suffix));
  return joined;
}

}  // namespace lorentz
