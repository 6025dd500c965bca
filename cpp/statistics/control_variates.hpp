#pragma once

#include <cstddef>

#include "statistics/records.hpp"

namespace lorentz {

/// Removes from measured columns the noise that they share with control variates.
///
/// The last `controls` columns of a record are control variates c, whose exact mean is 0. Every other column
/// y becomes y - b c, with the coefficients b of the linear regression of y on c over the other records: a
/// record's correction then has mean 0, and no bias comes in (Glasserman, Monte Carlo Methods in Financial
/// Engineering, section 4.1). Controls that do not vary are left out. With fewer than three records for each
/// of the others, or not eight records more than those, or if one varies in hardly more than one record, the
/// records come back as they are. The error of the mean follows from the scatter of the corrected records, as
/// they share nothing but the small noise of the coefficients.
Records reduce_variance(const Records& records, std::size_t controls);

}  // namespace lorentz
