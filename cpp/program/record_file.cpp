#include "program/record_file.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <span>
#include <sstream>
#include <system_error>
#include <utility>

#include "program/errors.hpp"
#include "program/hdf5_file.hpp"

namespace lorentz {
namespace {

/// Whether the file ends with the checksum of its preceding bytes.
bool is_whole(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  const std::string file = std::move(text).str();
  constexpr std::size_t digits = 8;
  return file.size() > digits &&
         file.ends_with(crc32_of(std::as_bytes(std::span(file.data(), file.size() - digits))));
}

}  // namespace

RecordFile::RecordFile(std::string identity, const std::vector<Description>& tallies)
    : identity_(std::move(identity)), tallies_(tallies) {}

std::vector<std::byte> RecordFile::content(const FinishedReplicas& finished) const {
  std::vector<std::uint64_t> indices, events;
  for (const auto& [index, record] : finished) {
    indices.push_back(index);
    events.push_back(record.events);
  }
  Hdf5Writer file;
  file.dataset("/replicas/index", {indices.size()}, indices);
  file.dataset("/replicas/events", {events.size()}, events);
  file.attribute("/replicas", "identity", identity_);
  std::size_t column = 0;
  for (const Description& tally : tallies_) {
    std::vector<double> values;
    for (const auto& [index, record] : finished) {
      const auto part = std::span(record.values).subspan(column, tally.size());
      values.insert(values.end(), part.begin(), part.end());
    }
    Shape shape{indices.size()};
    for (const Axis& axis : tally.axes) shape.push_back(axis.values.size());
    file.dataset("/tallies/" + tally.name, shape, values);
    file.attribute("/tallies/" + tally.name, "units", tally.units);
    file.attribute("/tallies/" + tally.name, "description", tally.description);
    column += tally.size();
  }
  std::vector<std::byte> content = file.image();
  for (const char digit : crc32_of(content)) content.push_back(static_cast<std::byte>(digit));
  return content;
}

std::optional<FinishedReplicas> RecordFile::read(const std::string& path) const {
  const auto require = [&path](bool whole) {
    if (!whole)
      throw UsageError(fmt::format("'{}' cannot be resumed or joined: it is damaged. Remove it.", path));
  };
  require(is_whole(path));
  const Hdf5Reader file(path);
  if (file.attribute("/replicas", "identity") != AttributeValue(identity_)) return {};
  const std::vector<std::uint64_t> indices = file.counts("/replicas/index");
  const std::vector<std::uint64_t> events = file.counts("/replicas/events");
  require(events.size() == indices.size());
  FinishedReplicas finished;
  for (std::size_t row = 0; row < indices.size(); ++row) finished[indices[row]].events = events[row];
  require(finished.size() == indices.size());
  for (const Description& tally : tallies_) {
    const std::vector<double> values = file.doubles("/tallies/" + tally.name);
    require(values.size() == indices.size() * tally.size());
    for (std::size_t row = 0; row < indices.size(); ++row) {
      const auto part = std::span(values).subspan(row * tally.size(), tally.size());
      std::vector<double>& record = finished[indices[row]].values;
      record.insert(record.end(), part.begin(), part.end());
    }
  }
  return finished;
}

FinishedReplicas RecordFile::join(const std::string& folder) const {
  const auto refuse = [](const std::string& what, const std::string& why) {
    throw UsageError(fmt::format("--join '{}': {}. Measure parts into a folder with --part.", what, why));
  };
  std::error_code unreadable;
  FinishedReplicas joined;
  for (const auto& entry : std::filesystem::directory_iterator(folder, unreadable)) {
    if (entry.path().extension() != part_suffix) continue;
    std::optional<FinishedReplicas> part = read(entry.path().string());
    if (!part) refuse(entry.path().string(), "it is of other options or another build");
    joined.merge(*part);
  }
  if (unreadable) refuse(folder, unreadable.message());
  if (joined.empty()) refuse(folder, fmt::format("no file there ends with {}", part_suffix));
  return joined;
}

}  // namespace lorentz
