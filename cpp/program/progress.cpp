#include "program/progress.hpp"

#include <fmt/format.h>

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

/// Of a number rounded to two digits: 0.0996 has -1.
int decimal_exponent(double x) {
  const std::string text = fmt::format("{:.1e}", x);
  return std::stoi(text.substr(text.find('e') + 1));
}

}  // namespace

Progress::Progress(std::string program) : program_(std::move(program)) {}

bool Progress::due() {
  const Clock::time_point now = Clock::now();
  if (style == "none" || now - last_shown_ < std::chrono::seconds(10)) return false;
  last_shown_ = now;
  return true;
}

void Progress::show(double done, std::uint64_t wanted, double resumed) {
  if (!due()) return;
  const double left = std::chrono::duration<double>(last_shown_ - start_).count() *
                      (static_cast<double>(wanted) - done) / (done - resumed);
  constexpr double longest = 1e8;  // s; a longer time left is a guess from hardly anything
  warn(fmt::format("{:.1f} of {}, {}", done, counted(wanted),
                   left < longest ? as_time(left) + " left" : "time left unknown"));
}

void Progress::say(const std::string& line) {
  if (style != "none") warn(line);
}

void Progress::warn(const std::string& line) {
  std::fputs(fmt::format("{}: {}\n", program_, line).c_str(), stderr);
}

std::string counted(std::uint64_t replicas) {
  return fmt::format("{} replica{}", replicas, replicas == 1 ? "" : "s");
}

std::string with_error(double mean, double error) {
  if (std::isnan(mean)) return "nan";  // without the sign that 0/0 has
  if (!(error > 0) || !std::isfinite(mean) || !std::isfinite(error)) return fmt::format("{:.8g}", mean);
  const int exponent = decimal_exponent(std::max(std::abs(mean), error));
  if (exponent < -4 || exponent >= 6) {  // as for {:g}
    const double unit = std::pow(10, exponent);
    return fmt::format("{}e{}", with_error(mean / unit, error / unit), exponent);
  }
  const int decimals = std::max(0, 1 - decimal_exponent(error));
  std::string digits = fmt::format("{:.{}f}", std::stod(fmt::format("{:.1e}", error)), decimals);
  if (error < 1) digits.erase(0, digits.find_first_of("123456789"));
  return fmt::format("{:.{}f}({})", mean, decimals, digits);
}

}  // namespace lorentz
