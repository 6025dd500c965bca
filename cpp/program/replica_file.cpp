#include "program/replica_file.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <span>
#include <system_error>

#include "program/errors.hpp"
#include "program/hdf5_file.hpp"

namespace lorentz {
namespace {

/// Whether the file ends with the checksum of its preceding bytes.
bool is_whole(const std::string& path) {
  std::string content(std::filesystem::file_size(path), '\0');
  std::ifstream(path, std::ios::binary).read(content.data(), static_cast<std::streamsize>(content.size()));
  constexpr std::size_t digits = 8;
  return content.size() > digits &&
         content.ends_with(crc32_of(std::as_bytes(std::span(content.data(), content.size() - digits))));
}

}  // namespace

std::vector<std::byte> ReplicaFile::content(const FinishedReplicas& finished) const {
  std::vector<std::uint64_t> indices, events;
  for (const auto& [index, one] : finished) {
    indices.push_back(index);
    events.push_back(one.events);
  }
  const Axis replica{"replica", "1", "Finished replicas", {indices.begin(), indices.end()}};
  Hdf5Writer file;
  file.array("/replicas", {"index", "1", "Number of the replica, from 0", {replica}}, indices);
  file.array("/replicas", {"events", "1", "Events of the replica", {replica}}, events);
  file.attribute("/replicas", "identity", identity);
  std::size_t column = 0;
  for (Description tally : tallies) {
    std::vector<double> values;
    for (const auto& [index, one] : finished) {
      const auto part = std::span(one.values).subspan(column, tally.size());
      values.insert(values.end(), part.begin(), part.end());
    }
    column += tally.size();
    tally.axes.insert(tally.axes.begin(), replica);
    file.array("/tallies", tally, values);
  }
  std::vector<std::byte> content = file.image();
  for (const char digit : crc32_of(content)) content.push_back(static_cast<std::byte>(digit));
  return content;
}

std::optional<FinishedReplicas> ReplicaFile::read(const std::string& path) const {
  if (!is_whole(path))
    throw UsageError(fmt::format("'{}' cannot be resumed or joined: it is damaged. Remove it.", path));
  const Hdf5Reader file(path);
  if (!file.has_attribute("/replicas", "identity", identity)) return {};
  const std::vector<std::uint64_t> indices = file.counts("/replicas/index");
  const std::vector<std::uint64_t> events = file.counts("/replicas/events");
  FinishedReplicas finished;
  for (std::size_t row = 0; row < indices.size(); ++row) finished[indices[row]].events = events.at(row);
  for (const Description& tally : tallies) {
    const std::vector<double> values = file.doubles("/tallies/" + tally.name);
    for (std::size_t row = 0; row < indices.size(); ++row) {
      const auto part = std::span(values).subspan(row * tally.size(), tally.size());
      std::vector<double>& of_replica = finished[indices[row]].values;
      of_replica.insert(of_replica.end(), part.begin(), part.end());
    }
  }
  return finished;
}

FinishedReplicas ReplicaFile::join(const std::string& folder) const {
  const auto refuse = [](const std::string& what, const std::string& why) {
    throw UsageError(fmt::format("--join '{}': {}. Measure parts into a folder with --part.", what, why));
  };
  std::error_code unreadable;  // is as good as empty
  FinishedReplicas joined;
  for (const auto& entry : std::filesystem::directory_iterator(folder, unreadable)) {
    if (entry.path().extension() != part_suffix) continue;
    std::optional<FinishedReplicas> part = read(entry.path().string());
    if (!part) refuse(entry.path().string(), "it is of other options or another build");
    joined.merge(*part);
  }
  if (joined.empty()) refuse(folder, fmt::format("no file there ends with {}", part_suffix));
  return joined;
}

}  // namespace lorentz
