#pragma once

#include <cstddef>

#include "statistics/records.hpp"

namespace lorentz {

/// p-value of the hypothesis that the first `columns` columns all have mean 0, by Hotelling's T^2 test: with
/// R records and columns of rank k, T^2 (R - k)/(k (R - 1)) has the F distribution with k and R - k degrees
/// of freedom if the records are independent and normal (Hotelling, Ann. Math. Stat. 2, 360 (1931)). `fitted`
/// coefficients that were taken from the same records, as those of control variates, count as so many records
/// less. NaN with too few records, or if no column varies.
double zero_mean_p_value(const Records& records, std::size_t columns, std::size_t fitted);

}  // namespace lorentz
