#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "program/program.hpp"
#include "program/replica_parameters.hpp"
#include "program/replicas.hpp"
#include "statistics/estimator.hpp"
#include "statistics/tally.hpp"

namespace lorentz {

/// Measurement over independent replicas: the tallies of a replica and the quantities estimated from them.
struct Study {
  TallySchema tallies;
  std::function<std::uint64_t(const Replica&, Record&)> measure;  // fills the record; returns the events
  std::vector<Estimator> estimators;
  std::string target;  // quantity of --target-error
};

/// Measures until the number of replicas or the target error is reached, or a part of the replicas, with
/// checkpoints, resumption and time limit. Throws UsageError, NumericalError or Interrupted.
Outcome run_study(const Study& study, const ReplicaParameters& parameters, const Program& program,
                  Progress& progress);

/// Main function of an executable that runs a study.
class StudyProgram {
 public:
  StudyProgram(const std::string& name, const std::string& description) : program_(name, description) {}

  Options& options() { return program_.options(); }

  /// Parses the command line, calls `make` for the study of the parsed parameters and runs it. `make` throws
  /// UsageError if options that are valid one by one exclude each other. Returns the exit status.
  int run(int argc, char** argv, const std::function<Study()>& make);

 private:
  Program program_;
  ReplicaParameters parameters_;
};

}  // namespace lorentz
