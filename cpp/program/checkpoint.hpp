#pragma once

#include <string>
#include <vector>

#include "program/replicas.hpp"
#include "statistics/description.hpp"

namespace lorentz {

/// File beside the output with the finished replicas of a run, from which an interrupted run resumes with the
/// loss of at most the replicas in progress.
class Checkpoint {
 public:
  /// identity: everything that the records depend on (parameters and build id); a checkpoint with another
  /// identity is rejected. tallies: arrays that make up a record.
  Checkpoint(const std::string& output, std::string identity, std::vector<Description> tallies);

  const std::string& path() const { return path_; }
  void save(const FinishedReplicas& finished) const;

  /// Empty if there is no file. Throws UsageError if the file is damaged or of another identity.
  FinishedReplicas load() const;
  void remove() const;

 private:
  FinishedReplicas read() const;

  std::string path_;
  std::string identity_;
  std::vector<Description> tallies_;
};

}  // namespace lorentz
