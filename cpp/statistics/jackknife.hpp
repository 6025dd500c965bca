#pragma once

#include <functional>
#include <span>
#include <vector>

#include "statistics/records.hpp"

namespace lorentz {

/// Values with their standard errors, same length. An error is NaN where it cannot be had.
struct Estimate {
  std::vector<double> mean;
  std::vector<double> standard_error;
};

/// Maps a mean record to the quantities of interest, for instance a ratio of two sums.
using RecordFunction = std::function<std::vector<double>(std::span<const double> mean_record)>;

/// f of the mean record, with the delete-one jackknife error over replicas (Efron & Stein 1981):
/// se^2 = (R-1)/R sum_r (f_(-r) - mean of f_(-r))^2. Needs two replicas for an error.
Estimate jackknife(const Records& records, const RecordFunction& f);

}  // namespace lorentz
