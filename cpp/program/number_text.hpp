#pragma once

#include <array>
#include <charconv>
#include <limits>
#include <string>
#include <system_error>

namespace lorentz {

/// The admissible values of a number: [low, high], or (low, high] when the lower end is excluded.
template <class Number>
struct Range {
  Number low = std::numeric_limits<Number>::lowest();
  Number high = std::numeric_limits<Number>::max();
  bool open_below = false;

  bool bounded_below() const { return low != std::numeric_limits<Number>::lowest() || low == 0; }
  bool bounded_above() const { return high != std::numeric_limits<Number>::max(); }
};

inline constexpr Range<double> positive{0, std::numeric_limits<double>::max(), true};
inline constexpr Range<double> non_negative{0};

/// A polynomial of the second degree in a size of the system, most often a number.
struct Scaled {
  std::array<double, 3> coefficients;  // of size^0, size^1, size^2

  double at(double size) const { return coefficients[0] + size * (coefficients[1] + size * coefficients[2]); }
};

template <class Number>
bool contains(const Range<Number>& range, Number value) {
  return (range.open_below ? value > range.low : value >= range.low) && value <= range.high;
}

/// Sets the value to a decimal number, rounded to nearest; false if the text is not one in the range.
template <class Number>
bool read_number(const std::string& text, const Range<Number>& range, Number& value) {
  const char* begin = text.data() + (text.starts_with('+') && !text.starts_with("+-") ? 1 : 0);
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(begin, end, value);
  return error == std::errc{} && stop == end && contains(range, value);
}

/// Sets the value to a sum of terms, each with another power of the size and a coefficient in the range;
/// false if the text is not one. symbol: of the size, as the N in 50+0.0004N^2.
bool read_polynomial(const std::string& text, const Range<double>& range, char symbol, Scaled& value);

/// The terms that are not 0.
std::string as_text(const Scaled& value, char symbol);

}  // namespace lorentz
