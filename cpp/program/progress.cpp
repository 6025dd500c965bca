#include "program/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "program/standard_streams.hpp"

namespace lorentz {
namespace {

using Seconds = std::chrono::duration<double>;

constexpr Seconds bar_interval{0.1};
constexpr Seconds log_interval{10};

Progress::Style chosen_style(const std::string& name) {
  if (name == "bar") return Progress::Style::bar;
  if (name == "log") return Progress::Style::log;
  if (name == "none") return Progress::Style::none;
  return ::isatty(STDERR_FILENO) ? Progress::Style::bar : Progress::Style::log;
}

std::string as_time(double seconds) {
  const auto whole = std::lround(seconds);
  if (whole >= 3600) return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

}  // namespace

Progress::Progress(std::string program, const std::string& style)
    : program_(std::move(program)), style_(chosen_style(style)) {}

Progress::~Progress() { clear_bar(); }

void Progress::show(double done, double wanted, double resumed) {
  const Clock::time_point now = Clock::now();
  if (style_ == Style::none || now - last_shown_ < (style_ == Style::bar ? bar_interval : log_interval))
    return;
  last_shown_ = now;
  const double elapsed = Seconds(now - start_).count();
  const double fresh = done - resumed;
  const std::string remaining =
      fresh > 0 ? as_time(elapsed * (wanted - done) / fresh) + " left" : std::string("time left unknown");
  if (style_ == Style::log) {
    print_error(fmt::format("{}: {:.1f} of {:.0f} replicas, {}\n", program_, done, wanted, remaining));
    return;
  }
  constexpr int width = 30;
  const int filled = std::clamp(static_cast<int>(width * done / wanted), 0, width);
  print_error(fmt::format("\r{} [{:#<{}}{:.<{}}] {:.1f}/{:.0f} replicas, {}\x1b[K", program_, "", filled, "",
                          width - filled, done, wanted, remaining));
  bar_drawn_ = true;
}

void Progress::say(const std::string& line) {
  if (style_ != Style::none) warn(line);
}

void Progress::warn(const std::string& line) {
  clear_bar();
  print_error(fmt::format("{}: {}\n", program_, line));
}

void Progress::clear_bar() {
  if (std::exchange(bar_drawn_, false)) print_error("\r\x1b[K");
}

}  // namespace lorentz
