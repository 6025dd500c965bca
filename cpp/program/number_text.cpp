#include "program/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace lorentz {
namespace {

/// What follows the coefficients of size^0, size^1 and size^2.
std::array<std::string, 3> powers_of(char symbol) { return {"", {symbol}, {symbol, '^', '2'}}; }

}  // namespace

bool read_polynomial(const std::string& text, const Range<double>& range, char symbol, Scaled& value) {
  const auto powers = powers_of(symbol);
  Scaled sum{};
  std::array<bool, 3> given{};
  const char* at = text.data() + (text.starts_with('+') ? 1 : 0);
  const char* const end = text.data() + text.size();
  for (;; ++at) {
    double coefficient = 0;
    const auto [stop, error] = std::from_chars(at, end, coefficient);
    const char* const next = std::find(stop, end, '+');
    const auto power = std::ranges::find(powers, std::string(stop, next)) - powers.begin();
    if (error != std::errc{} || !contains(range, coefficient) || power == 3 || given[power]) return false;
    sum.coefficients[power] = coefficient;
    given[power] = true;
    at = next;
    if (at == end) break;
  }
  value = sum;
  return true;
}

std::string as_text(const Scaled& value, char symbol) {
  std::vector<std::string> terms;
  for (std::size_t power = 0; power < value.coefficients.size(); ++power)
    if (value.coefficients[power] != 0)
      terms.push_back(fmt::format("{}{}", value.coefficients[power], powers_of(symbol)[power]));
  return fmt::format("{}", fmt::join(terms, "+"));
}

}  // namespace lorentz
