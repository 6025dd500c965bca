#pragma once

#include <chrono>
#include <string>

namespace lorentz {

/// Shows on standard error how far a run is and how long it will still take: one bar that is
/// redrawn, on a terminal; otherwise lines for a log, at most one every ten seconds.
class Progress {
 public:
  enum class Style { bar, log, none };

  /// style: auto, bar, log or none; auto chooses bar on a terminal and log elsewhere.
  Progress(std::string program, const std::string& style);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// done and wanted in replicas, fractions included; `resumed` of them were there at the start.
  void show(double done, double wanted, double resumed);

  /// A line of its own: a result, or why the run stopped.
  void say(const std::string& line);

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
