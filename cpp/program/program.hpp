#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "program/errors.hpp"
#include "program/options.hpp"
#include "program/progress.hpp"
#include "statistics/group.hpp"

namespace lorentz {

enum class Convergence { reached, not_reached, no_target };

/// Results of a run, and their provenance in the output file.
struct RunResult {
  Results results{};
  std::uint64_t events = 0;
  std::string target_quantity{};
  double target_error = 0;    // NaN without a target
  double achieved_error = 0;  // relative as the target; NaN if it is not known, as where all replicas agree
  double plain_error =
      std::numeric_limits<double>::quiet_NaN();  // without control variates, if there are any
  Convergence convergence = Convergence::not_reached;
  double former_seconds = 0;  // CPU time of the processes from whose checkpoint the run was resumed
};

/// Common part of every executable: options, one computation, one HDF5 file written atomically, a cost file
/// beside it, and the exit status.
class Program {
 public:
  Program(const std::string& name, const std::string& description);

  Options& options() { return options_; }
  Progress& progress() { return progress_; }
  const std::string& output() const { return output_; }
  double elapsed() const;  // seconds since the start of the program

  /// Parses the command line, computes and writes; with --help and --describe prints options and quantities
  /// instead. `quantities` describes what the parsed options compute, and throws UsageError if options that
  /// are valid one by one exclude each other; `compute` calls write(). Returns the exit status and never
  /// throws: errors are printed on standard error as one line.
  int run(int argc, char** argv, const std::function<std::vector<Description>()>& quantities,
          const std::function<ExitStatus()>& compute);

  /// Writes the output and the cost file. Throws UsageError.
  ExitStatus write(const RunResult& result) const;

 private:
  void require_replaceable() const;
  int fail(ExitStatus status, const std::string& message);

  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  Options options_;
  Progress progress_;
  std::string description_, output_;
  bool describe_ = false, overwrite_ = false;
};

}  // namespace lorentz
