#pragma once

#include <functional>
#include <string>

#include "program/record_file.hpp"

namespace lorentz {

/// File beside the output with the finished replicas of a run, from which an interrupted run resumes with the
/// loss of at most the replicas in progress.
class Checkpoint {
 public:
  Checkpoint(const std::string& output, RecordFile format);

  const std::string& path() const { return path_; }

  /// Throws UsageError if the file cannot be written; the one before it then remains.
  void save(const FinishedReplicas& finished) const;

  /// The saved replicas; none without a file, nor from one of another run, of which it warns with one line.
  /// Throws UsageError if the file is damaged.
  FinishedReplicas load(const std::function<void(const std::string&)>& warn) const;

  void remove() const;

 private:
  std::string path_;
  RecordFile format_;
};

}  // namespace lorentz
