#pragma once

#include <optional>
#include <vector>

#include "statistics/group.hpp"
#include "statistics/tally.hpp"

namespace lorentz {

/// Measured columns and the control variates on which they are regressed.
struct Regression {
  Columns measured, controls;
};

/// The measured columns of the records, in their order, with the control variates regressed out [eq. 33].
///
/// The controls x have the exact mean 0. A measured column y becomes y - b_(i).x with the leave-one-out
/// coefficients b_(i) of the linear regression of y on x. A record is independent of its coefficients, so its
/// correction has mean 0 and adds no bias (Glasserman, Monte Carlo Methods in Financial Engineering, section
/// 4.1). The standard error of the mean follows from the scatter of the corrected records, which are
/// correlated only through the sampling errors of the coefficients. Controls that do not vary are left out.
/// The result is empty without controls, with fewer than max(3k, k + 8) records for k varying controls, or
/// with a leverage above 0.99.
std::optional<Records> regress_out(const Records& records, const Regression& regression);

/// Variance over the records of a divided by that of b, averaged over columns. Columns that do not vary in b
/// are left out; 1 if none varies.
double variance_ratio(const Records& a, const Records& b, const Columns& columns);

/// Applies control variates if this is possible and lowers the variance of the measured columns of all
/// regressions on average; otherwise returns the records unchanged. Either all columns are corrected or
/// none, because neighbouring columns belong to one profile. A column that the controls determine, such as
/// the particles that enter at an opening, stays uncorrected: its corrected value would be the known mean
/// with an error of 0, which is not a measurement.
Group::Prepared reduce_variance(const Records& records, const std::vector<Regression>& regressions);

}  // namespace lorentz
