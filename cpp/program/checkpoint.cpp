#include "program/checkpoint.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <utility>

#include "program/atomic_file.hpp"
#include "program/errors.hpp"

namespace lorentz {

Checkpoint::Checkpoint(const std::string& output, RecordFile format)
    : path_(output + ".checkpoint"), format_(std::move(format)) {}

void Checkpoint::save(const FinishedReplicas& finished) const {
  if (!finished.empty()) write_atomically(path_, format_.content(finished));
}

FinishedReplicas Checkpoint::load(const std::function<void(const std::string&)>& warn) const {
  std::error_code unknown;
  if (!std::filesystem::exists(path_, unknown)) return {};
  switch (format_.state(path_)) {
    case RecordFile::State::whole:
      return format_.read(path_);
    case RecordFile::State::of_another_run:
      warn(fmt::format("'{}' is of other options or another build and is ignored; the run starts anew",
                       path_));
      return {};
    case RecordFile::State::damaged:
      break;
  }
  throw UsageError(
      fmt::format("'{}' cannot be resumed: the file is damaged. Remove it, or leave out --resume.", path_));
}

void Checkpoint::remove() const { ::unlink(path_.c_str()); }

}  // namespace lorentz
