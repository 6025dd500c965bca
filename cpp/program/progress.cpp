#include "program/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace lorentz {
namespace {

std::string as_time(double seconds) {
  const auto whole = std::lround(seconds);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

void print_error(const std::string& text) { std::fputs(text.c_str(), stderr); }

}  // namespace

Progress::Progress(std::string program) : program_(std::move(program)) {}

void Progress::show(double done, double wanted, double resumed) {
  using Seconds = std::chrono::duration<double>;
  const Clock::time_point now = Clock::now();
  const bool bar = style == "bar" || (style == "auto" && ::isatty(STDERR_FILENO));
  if (style == "none" || now - last_shown_ < Seconds(bar ? 0.1 : 10)) return;
  last_shown_ = now;
  const double fresh = done - resumed;
  const std::string remaining =
      fresh > 0 ? as_time(Seconds(now - start_).count() * (wanted - done) / fresh) + " left"
                : std::string("time left unknown");
  if (!bar) return warn(fmt::format("{:.1f} of {:.0f} replicas, {}", done, wanted, remaining));
  constexpr int width = 30;
  const int filled = std::clamp(static_cast<int>(width * done / wanted), 0, width);
  print_error(fmt::format("\r{} [{:#<{}}{:.<{}}] {:.1f}/{:.0f} replicas, {}\x1b[K", program_, "", filled, "",
                          width - filled, done, wanted, remaining));
  bar_drawn_ = true;
}

void Progress::say(const std::string& line) {
  if (style != "none") warn(line);
}

void Progress::warn(const std::string& line) {
  if (std::exchange(bar_drawn_, false)) print_error("\r\x1b[K");
  print_error(fmt::format("{}: {}\n", program_, line));
}

std::string with_error(double mean, double error) {
  if (!(error > 0) || !std::isfinite(mean) || !std::isfinite(error)) return fmt::format("{:.8g}", mean);
  const double largest = std::max(std::abs(mean), error);
  const int exponent = static_cast<int>(std::floor(std::log10(largest)));
  const bool plain = exponent >= -4 && exponent < 6;  // as for {:g}
  const double scale = plain ? 1 : std::pow(10, exponent);
  // Two digits, also where rounding carries: 0.0996 has the digits 10, not 100.
  int decimals = 1 - static_cast<int>(std::floor(std::log10(error / scale)));
  if (std::round(error / scale * std::pow(10, decimals)) >= 100) --decimals;
  const double unit = std::pow(10, decimals), rounded = std::round(error / scale * unit) / unit;
  decimals = std::max(decimals, 0);
  const std::string shown =
      rounded < 1 ? fmt::format("{:.0f}", rounded * unit) : fmt::format("{:.{}f}", rounded, decimals);
  return fmt::format("{:.{}f}({}){}", mean / scale, decimals, shown,
                     plain ? "" : fmt::format("e{}", exponent));
}

}  // namespace lorentz
