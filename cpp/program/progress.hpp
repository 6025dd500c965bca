#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace lorentz {

/// Progress and remaining time on standard error: lines, at most one every ten seconds.
class Progress {
 public:
  explicit Progress(std::string program);

  std::string style = "log";  // or none

  /// Whether a line is due.
  bool due();

  /// done and wanted: numbers of replicas, fractions included; resumed: how many of them come from a file.
  void show(double done, std::uint64_t wanted, double resumed);

  /// Prints a line unless the style is none: a result, or why the run stops.
  void say(const std::string& line);

  /// Prints a warning in every style, also `none`.
  void warn(const std::string& line);

 private:
  using Clock = std::chrono::steady_clock;

  std::string program_;
  Clock::time_point start_ = Clock::now(), last_shown_ = start_;
};

/// "0.3208(45)", "262.9(3.5)": a mean with two digits of its standard error.
std::string with_error(double mean, double error);

/// "1 replica", "2 replicas".
std::string counted(std::uint64_t replicas);

}  // namespace lorentz
