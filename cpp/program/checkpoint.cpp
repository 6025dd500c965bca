#include "program/checkpoint.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <zlib.h>

#include <filesystem>
#include <fstream>
#include <span>
#include <sstream>
#include <utility>

#include "program/atomic_file.hpp"
#include "program/errors.hpp"

namespace lorentz {
namespace {

/// CRC-32, which finds every error within 32 neighbouring bits, as eight hexadecimal digits.
std::string checksum(std::span<const std::byte> content) {
  const auto* bytes = reinterpret_cast<const Bytef*>(content.data());
  return fmt::format("{:08x}", ::crc32_z(0, bytes, content.size()));
}

bool exists(const std::string& path) {
  std::error_code unknown;
  return std::filesystem::exists(path, unknown);
}

/// Whether a regular file ends with the checksum of what precedes it.
bool is_whole(const std::string& path) {
  if (!std::filesystem::is_regular_file(path)) return false;
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  const std::string file = std::move(text).str();
  constexpr std::size_t digits = 8;
  if (file.size() < digits) return false;
  const std::span content(file.data(), file.size() - digits);
  return file.ends_with(checksum(std::as_bytes(content)));
}

}  // namespace

Checkpoint::Checkpoint(const std::string& output, std::string identity, std::vector<Description> tallies)
    : path_(output + ".checkpoint"),
      former_(path_ + ".old"),
      identity_(std::move(identity)),
      tallies_(std::move(tallies)) {}

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
  replace_atomically(path_, former_, content);
}

FinishedReplicas Checkpoint::load(const std::function<void(const std::string&)>& warn) const {
  std::string damaged;
  for (const std::string& path : paths()) {
    if (!exists(path)) continue;
    if (is_whole(path)) {
      const Hdf5Reader file(path);
      const bool belongs = file.text_attribute("/replicas", "identity") == identity_;
      if (!belongs && damaged.empty())
        throw UsageError(fmt::format(
            "'{}' cannot be resumed: it belongs to another build or other parameters. Remove it to start "
            "anew.",
            path));
      if (belongs) {
        if (!damaged.empty()) warn(fmt::format("{} is damaged; the run resumes from '{}'", damaged, path));
        return replicas_in(file);
      }
    }
    damaged += fmt::format("{}'{}'", damaged.empty() ? "" : ", ", path);
  }
  if (!damaged.empty())
    warn(fmt::format("nothing can be resumed from {}: damaged, or of another run; the run starts anew",
                     damaged));
  return {};
}

FinishedReplicas Checkpoint::replicas_in(const Hdf5Reader& file) const {
  FinishedReplicas finished;
  const std::vector<std::uint64_t> indices = file.counts("/replicas/index");
  const std::vector<std::uint64_t> events = file.counts("/replicas/events");
  const auto require = [](bool fits) {
    if (!fits)
      throw UsageError("a checkpoint has arrays of other sizes than this program writes. Remove it.");
  };
  require(!indices.empty() && events.size() == indices.size());
  for (std::size_t row = 0; row < indices.size(); ++row) finished[indices[row]].events = events[row];
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

void Checkpoint::remove() const {
  for (const std::string& path : paths()) ::unlink(path.c_str());
}

}  // namespace lorentz
