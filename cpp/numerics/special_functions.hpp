#pragma once

namespace lorentz {

/// Special functions from numerics/elementary.hpp, so that their results are the same on every processor.
/// GSL's use the C library's elementary functions. Relative errors are given for the tested arguments
/// (tests/cpp/numerics/special_functions_test.cpp).

/// Exponential integral E_1(x), the integral of exp(-t)/t from x to infinity, for x > 0. Error: 1e-14.
double exponential_integral(double x);

/// Number above which a chi-square variable has the given probability. Error: 1e-13.
double chi_square_quantile(double probability_above, double degrees_of_freedom);

/// Probability that a variable of the F distribution exceeds f. Error: 1e-12 for up to 1000
/// degrees of freedom.
double f_distribution_tail(double f, double numerator_degrees, double denominator_degrees);

}  // namespace lorentz
