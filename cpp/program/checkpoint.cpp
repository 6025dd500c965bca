#include "program/checkpoint.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <utility>

#include "program/atomic_file.hpp"
#include "program/errors.hpp"

namespace lorentz {
namespace {

bool exists(const std::string& path) {
  std::error_code unknown;
  return std::filesystem::exists(path, unknown);
}

}  // namespace

Checkpoint::Checkpoint(const std::string& output, RecordFile format)
    : path_(output + ".checkpoint"), former_(path_ + ".old"), format_(std::move(format)) {}

void Checkpoint::save(const FinishedReplicas& finished) const {
  if (!finished.empty()) replace_atomically(path_, former_, format_.content(finished));
}

FinishedReplicas Checkpoint::load(const std::function<void(const std::string&)>& warn) const {
  std::string damaged;
  for (const std::string& path : paths()) {
    if (!exists(path)) continue;
    const RecordFile::State state = format_.state(path);
    if (state == RecordFile::State::of_another_run && damaged.empty())
      throw UsageError(fmt::format(
          "'{}' cannot be resumed: it belongs to another build or other parameters. Remove it to start "
          "anew.",
          path));
    if (state == RecordFile::State::whole) {
      if (!damaged.empty()) warn(fmt::format("{} is damaged; the run resumes from '{}'", damaged, path));
      return format_.read(path);
    }
    damaged += fmt::format("{}'{}'", damaged.empty() ? "" : ", ", path);
  }
  if (!damaged.empty())
    warn(fmt::format("nothing can be resumed from {}: damaged, or of another run; the run starts anew",
                     damaged));
  return {};
}

void Checkpoint::remove() const {
  for (const std::string& path : paths()) ::unlink(path.c_str());
}

}  // namespace lorentz
