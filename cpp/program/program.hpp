#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "program/errors.hpp"
#include "program/options.hpp"
#include "program/progress.hpp"
#include "statistics/group.hpp"

namespace lorentz {

enum class Convergence { reached, not_reached, no_target };

/// Results of a run, and their provenance in the output file.
struct Outcome {
  Results results{};
  std::uint64_t seed = 0;
  std::string streams{};  // of random numbers
  std::uint64_t events = 0;
  std::string target_quantity{};
  double target_error = 0;    // NaN without a target
  double achieved_error = 0;  // relative, or absolute if the target was
  Convergence convergence = Convergence::not_reached;
  std::size_t replicas = 0;       // used for the results
  std::vector<std::byte> part{};  // content of the output if it is a part of a run, which has no results
};

/// Common part of every executable: options, one computation, one HDF5 file written atomically, a cost file
/// beside it, and the exit status.
class Program {
 public:
  Program(const std::string& name, const std::string& description);
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  virtual ~Program() = default;

  Options& options() { return options_; }

  /// Parses the command line, computes and writes; with --describe prints options and quantities as JSON
  /// instead. Returns the exit status and never throws: errors are printed on standard error as one line.
  int run(int argc, char** argv);

 protected:
  /// Quantities of the parsed options. Throws UsageError if options that are valid one by one exclude each
  /// other.
  virtual std::vector<Description> quantities() = 0;
  virtual Outcome compute() = 0;
  /// Called at the end with whether the output was written.
  virtual void after_writing(bool) {}

  const std::string& output() const { return output_; }
  Progress& progress() { return *progress_; }

 private:
  ExitStatus run_or_throw(int argc, char** argv);
  std::string description_in_json();
  void require_replaceable() const;
  void write_result(const Outcome& outcome) const;

  Options options_;
  std::string description_, output_, progress_style_ = "auto";
  bool describe_ = false, overwrite_ = false;
  std::optional<Progress> progress_;
};

}  // namespace lorentz
