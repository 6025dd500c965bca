#pragma once

#include <chrono>
#include <string>

namespace lorentz {

/// Displays progress and remaining time on standard error: on a terminal as a bar that is redrawn, otherwise
/// as log lines, at most one every ten seconds.
class Progress {
 public:
  enum class Style { bar, log, none };

  /// style: auto, bar, log or none; auto chooses bar on a terminal and log elsewhere.
  Progress(std::string program, const std::string& style);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// done and wanted: numbers of replicas, fractions included; resumed: how many of them come from a
  /// checkpoint.
  void show(double done, double wanted, double resumed);

  /// Prints a line: a result, or why the run stops.
  void say(const std::string& line);

  /// Prints a line in every style: something is wrong, and the run goes on.
  void warn(const std::string& line);

 private:
  using Clock = std::chrono::steady_clock;

  void clear_bar();

  std::string program_;
  Style style_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_shown_ = start_;
  bool bar_drawn_ = false;
};

}  // namespace lorentz
