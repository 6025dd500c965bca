#include "runs/closed_study.hpp"

#include <utility>

namespace lorentz {

Study closed_study(const ClosedParameters& parameters, const ClosedTallies& tallies,
                   const std::function<void(ClosedRun&, Record&)>& observe, std::vector<Estimator> estimators,
                   const std::string& target) {
  validate(parameters);
  estimators.push_back(conservation_errors(tallies));
  const auto measure = [=](const Replica& replica, Record& record) {
    ClosedRun run(parameters, replica);
    run.relax();
    observe(run, record);
    return run.finish(tallies, record);
  };
  return {.tallies = tallies, .measure = measure, .estimators = std::move(estimators), .target = target};
}

}  // namespace lorentz
