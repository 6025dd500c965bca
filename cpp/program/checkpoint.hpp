#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "program/hdf5_file.hpp"
#include "program/replicas.hpp"
#include "statistics/description.hpp"

namespace lorentz {

/// File beside the output with the finished replicas of a run, from which an interrupted run resumes with the
/// loss of at most the replicas in progress. It ends with a checksum of what precedes it. The one before it
/// is kept, so that a whole one exists at every moment after the first.
class Checkpoint {
 public:
  /// identity: everything that the records depend on (parameters and build id); a checkpoint with another
  /// identity is rejected. tallies: arrays that make up a record.
  Checkpoint(const std::string& output, std::string identity, std::vector<Description> tallies);

  const std::string& path() const { return path_; }
  std::array<std::string, 2> paths() const { return {path_, former_}; }  // the newest first

  /// Throws UsageError if the file cannot be written; the two before it then stay.
  void save(const FinishedReplicas& finished) const;

  /// The replicas of the newest file that is whole; none if there is no such file. Calls warn with one line
  /// if a damaged file is passed over. Throws UsageError if the newest file is whole and of another identity.
  FinishedReplicas load(const std::function<void(const std::string&)>& warn) const;

  void remove() const;

 private:
  FinishedReplicas replicas_in(const Hdf5Reader& file) const;

  std::string path_, former_;
  std::string identity_;
  std::vector<Description> tallies_;
};

}  // namespace lorentz
