#include "program/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "program/atomic_file.hpp"
#include "program/errors.hpp"
#include "program/hdf5_file.hpp"

namespace lorentz {
namespace {

void write(Hdf5Writer& file, const Checkpoint& checkpoint, const FinishedReplicas& finished) {
  std::vector<std::uint64_t> indices, events;
  for (const auto& [index, one] : finished) {
    indices.push_back(index);
    events.push_back(one.events);
  }
  const Axis replica{"replica", "1", "Finished replicas", {indices.begin(), indices.end()}};
  file.array("/replicas", {"index", "1", "Number of the replica, from 0", {replica}}, indices);
  file.array("/replicas", {"events", "1", "Events of the replica", {replica}}, events);
  std::size_t column = 0;
  for (Description tally : checkpoint.tallies) {
    std::vector<double> values;
    for (const auto& [index, one] : finished) {
      const auto part = std::span(one.values).subspan(column, tally.size());
      values.insert(values.end(), part.begin(), part.end());
    }
    column += tally.size();
    tally.axes.insert(tally.axes.begin(), replica);
    file.array("/tallies", tally, std::move(values));
  }
  file.attribute("/replicas", "identity", checkpoint.identity);
  file.attribute("/replicas", "digest", file.digest(""));
}

}  // namespace

void Checkpoint::save(const FinishedReplicas& finished) const {
  Hdf5Writer file;
  write(file, *this, finished);
  write_atomically(path, file.image());
}

std::optional<FinishedReplicas> Checkpoint::load() const try {
  const Hdf5Reader file(path);
  if (!file.has_attribute("/replicas", "identity", identity)) return {};
  const std::vector<std::uint64_t> indices = file.counts("/replicas/index");
  const std::vector<std::uint64_t> events = file.counts("/replicas/events");
  FinishedReplicas finished;
  for (std::size_t row = 0; row < indices.size(); ++row) finished[indices[row]].events = events.at(row);
  for (const Description& tally : tallies) {
    const std::vector<double> values = file.doubles("/tallies/" + tally.name);
    if (values.size() != indices.size() * tally.size()) throw NumericalError("a tally has another size");
    for (std::size_t row = 0; row < indices.size(); ++row) {
      const auto part = std::span(values).subspan(row * tally.size(), tally.size());
      std::vector<double>& of_replica = finished[indices[row]].values;
      of_replica.insert(of_replica.end(), part.begin(), part.end());
    }
  }
  Hdf5Writer again;
  write(again, *this, finished);
  if (!file.has_attribute("/replicas", "digest", again.digest("")))
    throw NumericalError("the digest differs");
  return finished;
} catch (const NumericalError&) {
  throw UsageError(fmt::format("'{}' cannot be resumed: it is damaged. Remove it.", path));
}

}  // namespace lorentz
