#pragma once

#include <atomic>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <system_error>
#include <thread>
#include <type_traits>

/// Parts of C++20 that libc++, the standard library of macOS, lacks in versions 16 to 19.
namespace lorentz {

/// std::from_chars. The character at `end` must be readable and no part of a number.
template <class Number>
std::from_chars_result from_chars(const char* begin, const char* end, Number& value) {
#ifndef __cpp_lib_to_chars
  if constexpr (std::is_same_v<Number, double>) {
    // Neither spaces, a plus sign nor hexadecimal numbers, all of which strtod accepts.
    const char* const first = begin + (begin != end && *begin == '-' ? 1 : 0);
    if (first == end || std::isspace(*first) || *first == '+' || *first == '-' ||
        std::tolower(first[1]) == 'x')
      return {begin, std::errc::invalid_argument};
    char* stop = nullptr;
    errno = 0;
    const double number = std::strtod(begin, &stop);
    if (errno == ERANGE) return {stop, std::errc::result_out_of_range};
    if (stop == begin) return {begin, std::errc::invalid_argument};
    value = number;
    return {stop, std::errc{}};
  } else
#endif
    return std::from_chars(begin, end, value);
}

/// std::jthread without a stop token.
struct JoiningThread : std::thread {
  using std::thread::thread;
  JoiningThread(JoiningThread&&) = default;
  ~JoiningThread() {
    if (joinable()) join();
  }
};

/// sum += x.
inline void add(std::atomic<double>& sum, double x) {
  double before = sum;
  while (!sum.compare_exchange_weak(before, before + x)) continue;
}

}  // namespace lorentz
