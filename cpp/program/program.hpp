#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "program/errors.hpp"
#include "program/options.hpp"
#include "program/progress.hpp"
#include "statistics/quantity.hpp"

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

  /// Called at the end with whether the results were written.
  std::function<void(bool)> after_writing = [](bool) {};
};

/// Common part of every executable: options, one computation, one HDF5 file written atomically, a cost file
/// beside it, and the exit status.
class Program {
 public:
  Program(const std::string& name, const std::string& description);

  Options& options() { return options_; }
  const Options& options() const { return options_; }
  const std::string& output() const { return output_; }

  using Describe = std::function<std::vector<Description>()>;
  using Compute = std::function<Outcome(Progress&)>;

  /// Parses the command line, computes and writes; with --describe prints options and quantities as JSON
  /// instead. Returns the exit status and never throws: errors are printed on standard error as one line.
  int run(int argc, char** argv, const Describe& describe, const Compute& compute);

 private:
  ExitStatus run_or_throw(int argc, char** argv, const Describe& describe, const Compute& compute);
  void print_description(const std::vector<Description>& quantities) const;
  void require_replaceable() const;
  void write_result(const Outcome& outcome) const;
  void write_output(const Outcome& outcome, const std::string& cost) const;

  Options options_;
  std::string description_;
  bool describe_ = false;
  std::string output_;
  bool overwrite_ = false;
  std::string progress_ = "auto";
};

}  // namespace lorentz
