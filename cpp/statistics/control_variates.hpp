#pragma once

#include <cstddef>
#include <optional>

#include "statistics/records.hpp"

namespace lorentz {

/// Regresses control variates out of measured columns.
///
/// The last `controls` columns of a record are control variates c, whose exact mean is 0. Every other column
/// y becomes y - b c, with the coefficients b of the linear regression of y on c over the other records: a
/// record's correction then has mean 0, and no bias comes in (Glasserman, Monte Carlo Methods in Financial
/// Engineering, section 4.1). Controls that do not vary are left out. Nothing comes back without controls,
/// with fewer than three records for each of those that vary or not eight more than those, or if one varies
/// in hardly more than one record. The error of the mean follows from the scatter of the corrected records,
/// as they share nothing but the small noise of the coefficients.
std::optional<Records> regress_out(const Records& records, std::size_t controls);

/// Mean over columns from `first` on of the variance over records of a, divided by that of b. Columns
/// that do not vary in b are left out; 1 if none does.
double variance_ratio(const Records& a, const Records& b, std::size_t first, std::size_t columns);

/// Records that control variates may have been regressed out of.
struct ReducedRecords {
  Records records;
  bool control_variates;  // whether they were used
};

/// Uses the control variates if that is possible and makes the columns scatter less on average; otherwise the
/// records come back as they are. The columns are treated alike, because neighbours in a profile belong
/// together.
ReducedRecords reduce_variance(const Records& records, std::size_t controls);

}  // namespace lorentz
