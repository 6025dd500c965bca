#pragma once

#include <cstddef>

#include "statistics/tally.hpp"

namespace lorentz {

/// p-value of the hypothesis that the means of all given columns are 0, by Hotelling's T^2 test (Ann. Math.
/// Stat. 2, 360 (1931)): with independent normal records and columns of rank k, T^2 (R' - k)/(k (R' - 1)) has
/// the F distribution with k and R' - k degrees of freedom [eq. 51]. T^2 is that of all R records, and R' = R
/// - `fitted`, the number of coefficients estimated from the same records, such as those of control variates.
/// NaN with too few records, or if no column varies.
double zero_mean_p_value(const Records& records, const Columns& columns, std::size_t fitted);

}  // namespace lorentz
