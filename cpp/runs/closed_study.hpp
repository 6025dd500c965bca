#pragma once

#include <functional>
#include <string>
#include <vector>

#include "program/study.hpp"
#include "runs/closed_run.hpp"

namespace lorentz {

/// Study of a closed chain: every replica relaxes, `observe` takes the run through its observation and fills
/// the record, and the conservation errors are added. Throws UsageError where options are possible one by one
/// but not together.
Study closed_study(const ClosedParameters& parameters, const ClosedTallies& tallies,
                   const std::function<void(ClosedRun&, Record&)>& observe, std::vector<Estimator> estimators,
                   const std::string& target);

}  // namespace lorentz
