#include "program/checkpoint.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "program/atomic_file.hpp"
#include "program/errors.hpp"
#include "program/hdf5_file.hpp"

namespace lorentz {

Checkpoint::Checkpoint(const std::string& output, std::string identity, std::vector<Description> tallies)
    : path_(output + ".checkpoint"), identity_(std::move(identity)), tallies_(std::move(tallies)) {}

void Checkpoint::save(const FinishedReplicas& finished) const {
  if (finished.empty()) return;
  std::vector<std::uint64_t> indices, events;
  for (const auto& [index, record] : finished) {
    indices.push_back(index);
    events.push_back(record.events);
  }
  Hdf5Writer file;
  file.dataset("/replicas/index", {indices.size()}, indices);
  file.dataset("/replicas/events", {events.size()}, events);
  std::ptrdiff_t column = 0;
  for (const Description& tally : tallies_) {
    std::vector<double> values;
    const auto size = static_cast<std::ptrdiff_t>(tally.size());
    for (const auto& [index, record] : finished) {
      const auto first = record.values.begin() + column;
      values.insert(values.end(), first, first + size);
    }
    file.dataset("/tallies/" + tally.name, {indices.size(), tally.size()}, values);
    column += size;
  }
  file.attribute("/replicas", "identity", identity_);
  write_atomically(path_, file.image());
}

FinishedReplicas Checkpoint::load() const {
  if (!std::filesystem::exists(path_)) return {};
  try {
    return read();
  } catch (const UsageError&) {
    throw;
  } catch (const std::exception& error) {  // a damaged file causes various HDF5 errors
    throw UsageError(fmt::format("'{}' cannot be resumed: it is damaged ({}). Remove it to start anew.",
                                 path_, error.what()));
  }
}

FinishedReplicas Checkpoint::read() const {
  FinishedReplicas finished;
  const Hdf5Reader file(path_);
  if (file.text_attribute("/replicas", "identity") != identity_)
    throw UsageError(fmt::format(
        "'{}' cannot be resumed: it belongs to another build or other parameters. Remove it to start anew.",
        path_));
  const std::vector<std::uint64_t> indices = file.counts("/replicas/index");
  const std::vector<std::uint64_t> events = file.counts("/replicas/events");
  const std::string damaged =
      fmt::format("'{}' cannot be resumed: it is damaged. Remove it to start anew.", path_);
  if (indices.empty() || events.size() != indices.size()) throw UsageError(damaged);
  for (std::size_t row = 0; row < indices.size(); ++row) finished[indices[row]].events = events[row];
  for (const Description& tally : tallies_) {
    const std::vector<double> values = file.doubles("/tallies/" + tally.name);
    if (values.size() != indices.size() * tally.size()) throw UsageError(damaged);
    auto first = values.begin();
    for (const std::uint64_t index : indices) {
      std::vector<double>& record = finished[index].values;
      record.insert(record.end(), first, first + static_cast<std::ptrdiff_t>(tally.size()));
      first += static_cast<std::ptrdiff_t>(tally.size());
    }
  }
  return finished;
}

void Checkpoint::remove() const { std::filesystem::remove(path_); }

}  // namespace lorentz
