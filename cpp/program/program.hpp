#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "program/errors.hpp"
#include "program/options.hpp"
#include "program/progress.hpp"
#include "program/results.hpp"

namespace lorentz {

enum class Convergence { reached, not_reached, no_target };

/// What a run found, and what the output file says of how it was found.
struct Outcome {
  Results results{};
  std::uint64_t seed = 0;
  std::string streams{};  // of random numbers
  std::uint64_t events = 0;
  std::string target_quantity{};
  double target_error = 0;    // NaN if none was asked for
  double achieved_error = 0;  // relative, or absolute if the target was
  Convergence convergence = Convergence::not_reached;
};

/// The frame of every executable: options, one computation, one HDF5 file written whole, the cost
/// beside it, and the exit status.
class Program {
 public:
  Program(const std::string& name, const std::string& description);

  Options& options() { return options_; }
  const Options& options() const { return options_; }
  const std::string& output() const { return output_; }

  /// Parses the command line, computes, writes. Returns the exit status; never throws. Errors go to
  /// standard error as one line.
  int run(int argc, char** argv, const std::function<Outcome(Progress&)>& compute);

 private:
  ExitStatus run_or_throw(int argc, char** argv, const std::function<Outcome(Progress&)>& compute);
  void write_output(const Outcome& outcome) const;

  Options options_;
  std::string output_;
  std::string progress_ = "auto";
};

}  // namespace lorentz
