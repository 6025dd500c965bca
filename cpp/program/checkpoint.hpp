#pragma once

#include <array>
#include <functional>
#include <string>

#include "program/record_file.hpp"

namespace lorentz {

/// File beside the output with the finished replicas of a run, from which an interrupted run resumes with the
/// loss of at most the replicas in progress. The one before it is kept, so that a whole one exists at every
/// moment after the first.
class Checkpoint {
 public:
  /// A checkpoint of another run is rejected.
  Checkpoint(const std::string& output, RecordFile format);

  const std::string& path() const { return path_; }
  std::array<std::string, 2> paths() const { return {path_, former_}; }  // the newest first

  /// Throws UsageError if the file cannot be written; the two before it then stay.
  void save(const FinishedReplicas& finished) const;

  /// The replicas of the newest file that is whole; none if there is no such file. Calls warn with one line
  /// if a damaged file is passed over. Throws UsageError if the newest file is whole and of another run.
  FinishedReplicas load(const std::function<void(const std::string&)>& warn) const;

  void remove() const;

 private:
  std::string path_, former_;
  RecordFile format_;
};

}  // namespace lorentz
