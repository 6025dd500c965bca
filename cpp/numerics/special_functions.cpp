#include "numerics/special_functions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lorentz {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Continued fraction b_0 + a_1/(b_1 + a_2/(b_2 + ...)) by Lentz's method (Appl. Opt. 15, 668 (1976)), until
/// a factor is 1 to rounding. Terms are called with n = 1, 2, ... and return a_n and b_n.
struct Term {
  double a, b;
};
template <class Terms>
double continued_fraction(double first, const Terms& terms) {
  double value = first, c = first, d = 0;
  for (int n = 1;; ++n) {
    const auto [a, b] = terms(n);
    d = 1 / (b + a * d);
    c = b + a / c;
    value *= c * d;
    if (!(std::abs(c * d - 1) > epsilon)) return value;
  }
}

/// ln Gamma(x) minus Stirling's formula (x - 1/2) ln x - x + ln(2 pi)/2, for x > 0.
double stirling_error(double x) {
  double error = 0;
  for (; x < 16; ++x) error += (x + 0.5) * std::log1p(1 / x) - 1;
  const double y = 1 / (x * x);
  return error + (1. / 12 + y * (-1. / 360 + y * (1. / 1260 + y * (-1. / 1680 + y * (1. / 1188))))) / x;
}

/// Density at ln x of a gamma variable of shape a: x^a exp(-x) / Gamma(a).
double gamma_density(double a, double x) {
  const double deviation = x / a - 1;
  return std::exp(-a * (deviation - std::log1p(deviation)) - stirling_error(a)) *
         std::sqrt(a / (2 * std::numbers::pi));
}

/// Probability that a gamma variable of shape a exceeds x.
double gamma_tail(double a, double x) {
  const double density = gamma_density(a, x);
  if (x > a + 1)
    return density /
           continued_fraction(x + 1 - a, [=](double n) { return Term{n * (a - n), x + 2 * n + 1 - a}; });
  double term = 1 / a, sum = term;
  for (double n = 1; term > epsilon * sum; ++n) sum += term *= x / (a + n);
  return 1 - density * sum;
}

/// Regularised incomplete beta function I_x(a, b) where the fraction converges, x <= (a + 1)/(a + b + 2).
double beta_fraction(double a, double b, double x) {
  const double whole = a + b;
  const double logarithm = a * std::log(x * whole / a) + b * std::log((1 - x) * whole / b) +
                           stirling_error(whole) - stirling_error(a) - stirling_error(b);
  const double front = std::exp(logarithm) * std::sqrt(b / (2 * std::numbers::pi * a * whole));
  return front / continued_fraction(1, [=](int n) {
           const double m = n / 2;
           const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
           const double odd = -(a + m) * (whole + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
           return Term{n % 2 == 0 ? even : odd, 1};
         });
}

}  // namespace

double exponential_integral(double x) {
  if (x > 1)
    return std::exp(-x) / continued_fraction(x + 1, [=](double n) { return Term{-n * n, x + 2 * n + 1}; });
  double term = -1, sum = 0;
  for (double n = 1; std::abs(term) > epsilon * std::abs(sum); ++n) {
    term *= -x / n;
    sum += term / n;
  }
  return sum - std::log(x) - std::numbers::egamma;
}

double chi_square_quantile(double probability_above, double degrees_of_freedom) {
  const double shape = 0.5 * degrees_of_freedom;
  double low = 0, high = std::numeric_limits<double>::infinity(), x = shape;
  for (;;) {  // Newton's method within a bracket
    const double excess = gamma_tail(shape, x) - probability_above;
    (excess > 0 ? low : high) = x;
    double next = x * (1 + excess / gamma_density(shape, x));
    if (!(low < next && next < high)) next = high > 4 * x ? 2 * x : 0.5 * (low + high);
    if (std::abs(next - x) <= 4 * epsilon * x) return 2 * next;
    x = next;
  }
}

double f_distribution_tail(double f, double numerator_degrees, double denominator_degrees) {
  if (!(f > 0)) return f <= 0 ? 1 : f;
  const double a = 0.5 * denominator_degrees, b = 0.5 * numerator_degrees;
  const double x = a / (a + b * f), complement = b * f / (a + b * f);
  return x <= (a + 1) / (a + b + 2) ? beta_fraction(a, b, x) : 1 - beta_fraction(b, a, complement);
}

}  // namespace lorentz
