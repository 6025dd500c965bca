#pragma once

#include <string>

#include "program/replicas.hpp"

namespace lorentz {

/// The finished replicas of a run that goes on, kept in a file beside the output so that an
/// interrupted run loses at most the replicas in progress.
class Checkpoint {
 public:
  /// identity: everything that the records depend on (parameters and build id). A checkpoint of
  /// another identity is refused on resumption.
  Checkpoint(const std::string& output, std::string identity);

  const std::string& path() const { return path_; }
  void save(const FinishedReplicas& finished) const;

  /// Empty if there is no file. Throws UsageError if the file is damaged or of another identity.
  FinishedReplicas load() const;
  void remove() const;

 private:
  FinishedReplicas read() const;

  std::string path_;
  std::string identity_;
};

}  // namespace lorentz
