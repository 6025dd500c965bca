#include "program/record_file.hpp"

#include <fmt/format.h>
#include <zlib.h>

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

/// CRC-32, which finds every error within 32 neighbouring bits, as eight hexadecimal digits.
std::string checksum(std::span<const std::byte> content) {
  const auto* bytes = reinterpret_cast<const Bytef*>(content.data());
  return fmt::format("{:08x}", ::crc32_z(0, bytes, content.size()));
}

/// Whether a regular file ends with the checksum of what precedes it.
bool is_whole(const std::string& path) {
  std::error_code unreadable;
  if (!std::filesystem::is_regular_file(path, unreadable)) return false;
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  const std::string file = std::move(text).str();
  constexpr std::size_t digits = 8;
  if (file.size() < digits) return false;
  const std::span content(file.data(), file.size() - digits);
  return file.ends_with(checksum(std::as_bytes(content)));
}

}  // namespace

RecordFile::RecordFile(std::string identity, std::vector<Description> tallies)
    : identity_(std::move(identity)), tallies_(std::move(tallies)) {}

std::vector<std::byte> RecordFile::content(const FinishedReplicas& finished) const {
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
    Shape shape{indices.size()};
    for (const Axis& axis : tally.axes) shape.push_back(axis.values.size());
    file.dataset("/tallies/" + tally.name, shape, values);
    file.attribute("/tallies/" + tally.name, "units", tally.units);
    file.attribute("/tallies/" + tally.name, "description", tally.description);
    column += size;
  }
  file.attribute("/replicas", "identity", identity_);
  std::vector<std::byte> content = file.image();
  for (const char digit : checksum(content)) content.push_back(static_cast<std::byte>(digit));
  return content;
}

RecordFile::State RecordFile::state(const std::string& path) const {
  if (!is_whole(path)) return State::damaged;
  const bool belongs = Hdf5Reader(path).attribute("/replicas", "identity") == AttributeValue(identity_);
  return belongs ? State::whole : State::of_another_run;
}

FinishedReplicas RecordFile::read(const std::string& path) const {
  if (state(path) != State::whole)
    throw UsageError(fmt::format("'{}' is damaged, or belongs to another build or other parameters", path));
  const Hdf5Reader file(path);
  FinishedReplicas finished;
  const std::vector<std::uint64_t> indices = file.counts("/replicas/index");
  const std::vector<std::uint64_t> events = file.counts("/replicas/events");
  const auto require = [&path](bool fits) {
    if (!fits)
      throw UsageError(
          fmt::format("'{}' has arrays of other sizes than this program writes. Remove it.", path));
  };
  require(!indices.empty() && events.size() == indices.size());
  for (std::size_t row = 0; row < indices.size(); ++row) finished[indices[row]].events = events[row];
  require(finished.size() == indices.size());
  for (const Description& tally : tallies_) {
    const std::vector<double> values = file.doubles("/tallies/" + tally.name);
    require(values.size() == indices.size() * tally.size());
    auto first = values.begin();
    for (const std::uint64_t index : indices) {
      std::vector<double>& record = finished[index].values;
      record.insert(record.end(), first, first + static_cast<std::ptrdiff_t>(tally.size()));
      first += static_cast<std::ptrdiff_t>(tally.size());
    }
  }
  return finished;
}

}  // namespace lorentz
