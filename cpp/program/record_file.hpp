#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "program/replicas.hpp"
#include "statistics/description.hpp"

namespace lorentz {

/// Files with finished replicas of one run: checkpoints and parts. HDF5, and a checksum of what precedes it.
class RecordFile {
 public:
  /// identity: everything that the records depend on (parameters and build id). tallies: arrays that make up
  /// a record.
  RecordFile(std::string identity, std::vector<Description> tallies);

  std::vector<std::byte> content(const FinishedReplicas& finished) const;

  enum class State { whole, damaged, of_another_run };
  State state(const std::string& path) const;

  /// Throws UsageError, which names the file, if it is not whole.
  FinishedReplicas read(const std::string& path) const;

 private:
  std::string identity_;
  std::vector<Description> tallies_;
};

}  // namespace lorentz
