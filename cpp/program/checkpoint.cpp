#include "program/checkpoint.hpp"

#include <fmt/format.h>

#include <span>

#include "program/atomic_file.hpp"
#include "program/cpu_time.hpp"
#include "program/errors.hpp"
#include "program/hdf5_file.hpp"
#include "statistics/tally.hpp"

namespace lorentz {
void Checkpoint::save(const FinishedReplicas& finished) const {
  Hdf5Writer file;
  std::vector<std::int64_t> indices, events;
  std::vector<double> values;
  for (const auto& [index, one] : finished) {
    indices.push_back(static_cast<std::int64_t>(index));
    events.push_back(static_cast<std::int64_t>(one.events));
    values.insert(values.end(), one.values.begin(), one.values.end());
  }
  const Axis replica{"replica", "1", "Finished replicas", {indices.begin(), indices.end()}};
  const Axis column = numbered_axis("column", "Tallies, one after another", values.size() / finished.size());
  file.array("/replicas", {"index", "1", "Number of the replica, from 0", {replica}}, indices);
  file.array("/replicas", {"events", "1", "Events of the replica", {replica}}, events);
  file.array("/replicas", {"tallies", "1", "Sums of the replica", {replica, column}}, values);
  file.array("/replicas", {"cpu_seconds", "second", "CPU time of all processes of the run", {}},
             std::vector{former_seconds + cpu_seconds()});
  file.attribute("/replicas", "identity", identity);
  write_atomically(path, file.image());
}

FinishedReplicas Checkpoint::load() try {
  const Hdf5Reader file(path);
  if (!file.has_attribute("/replicas", "identity", identity)) return {};
  if (!is_intact(path)) throw NumericalError("the checksum differs");
  const std::vector<std::int64_t> indices = file.counts("/replicas/index");
  const std::vector<std::int64_t> events = file.counts("/replicas/events");
  const std::vector<double> values = file.doubles("/replicas/tallies");
  if (indices.empty() || events.size() != indices.size() || values.size() % indices.size() != 0)
    throw NumericalError("the replicas differ in number");
  const std::size_t width = values.size() / indices.size();
  FinishedReplicas finished;
  for (std::size_t row = 0; row < indices.size(); ++row) {
    const auto part = std::span(values).subspan(row * width, width);
    finished[static_cast<std::uint64_t>(indices[row])] = {{part.begin(), part.end()},
                                                          static_cast<std::uint64_t>(events[row])};
  }
  former_seconds = file.doubles("/replicas/cpu_seconds").front();
  return finished;
} catch (const NumericalError&) {
  throw UsageError(fmt::format("'{}' cannot be resumed: it is damaged. Remove it.", path));
}

}  // namespace lorentz
