#pragma once

#include <functional>
#include <span>
#include <vector>

#include "statistics/records.hpp"

namespace lorentz {

/// Values and their standard errors, of the same length. An undefined error is NaN.
struct Estimate {
  std::vector<double> mean;
  std::vector<double> standard_error;
};

/// Maps a mean record to the quantities of interest, for instance a ratio of two sums.
using RecordFunction = std::function<std::vector<double>(std::span<const double> mean_record)>;

/// f of the mean record with its leave-one-out jackknife error over replicas (Efron & Stein, Ann. Stat. 9,
/// 586 (1981)), se^2 = (R-1)/R sum_r (f_(r) - mean of f_(r))^2 [eq. 49]. Valid for independent replicas and
/// smooth f. The bias of f, of order 1/R, is not corrected; se^2 is biased upwards. With fewer than two
/// replicas the error is NaN.
Estimate jackknife(const Records& records, const RecordFunction& f);

}  // namespace lorentz
