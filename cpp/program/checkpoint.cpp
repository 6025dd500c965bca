#include "program/checkpoint.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "program/atomic_file.hpp"
#include "program/errors.hpp"
#include "program/hdf5_file.hpp"

namespace lorentz {

Checkpoint::Checkpoint(const std::string& output, std::string identity)
    : path_(output + ".checkpoint"), identity_(std::move(identity)) {}

void Checkpoint::save(const FinishedReplicas& finished) const {
  if (finished.empty()) return;
  std::vector<std::uint64_t> indices, events;
  std::vector<double> values;
  for (const auto& [index, record] : finished) {
    indices.push_back(index);
    events.push_back(record.events);
    values.insert(values.end(), record.values.begin(), record.values.end());
  }
  Hdf5Writer file;
  file.dataset("/replicas/index", {indices.size()}, indices);
  file.dataset("/replicas/events", {events.size()}, events);
  file.dataset("/replicas/values", {indices.size(), values.size() / indices.size()}, values);
  file.attribute("/replicas", "identity", identity_);
  write_atomically(path_, file.image());
}

FinishedReplicas Checkpoint::load() const {
  if (!std::filesystem::exists(path_)) return {};
  try {
    return read();
  } catch (const UsageError&) {
    throw;
  } catch (const std::exception& error) {  // HDF5 stumbles over damage in many ways
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
  const std::vector<double> values = file.doubles("/replicas/values");
  if (indices.empty() || events.size() != indices.size() || values.size() % indices.size() != 0)
    throw UsageError(fmt::format("'{}' cannot be resumed: it is damaged. Remove it to start anew.", path_));
  const std::size_t width = values.size() / indices.size();
  for (std::size_t row = 0; row < indices.size(); ++row) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(row * width);
    finished[indices[row]] = {{begin, begin + static_cast<std::ptrdiff_t>(width)}, events[row]};
  }
  return finished;
}

void Checkpoint::remove() const { std::filesystem::remove(path_); }

}  // namespace lorentz
