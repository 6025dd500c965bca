#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sampling/closed_run.hpp"

namespace lorentz {

/// Base of an observer whose quantities are numbers, each a sum over events divided by the number of events
/// or by a constant. A member of type Average declares a quantity; hooks (engine/observation.hpp) add to it.
class Averages {
 public:
  struct Average {
    double sum = 0;
    std::int64_t count = 0;  // the part of the sum that was added as whole numbers, which is faster
    const char *name, *units, *description;
    std::optional<double> divisor;  // of the sum; none: the number of calls of count()

    Average(Averages* observer, const char* of_name, const char* of_units, const char* of_description,
            std::optional<double> of_divisor = {})
        : name(of_name), units(of_units), description(of_description), divisor(of_divisor) {
      observer->all_.push_back(this);
    }
    void operator+=(double value) { sum += value; }
    void operator+=(int value) { count += value; }
    double total() const { return sum + static_cast<double>(count); }
  };

  Averages() = default;
  Averages(const Averages&) = delete;  // all_ points to members
  Averages& operator=(const Averages&) = delete;

  void count() { ++count_; }
  std::uint64_t counted() const { return count_; }
  const std::vector<const Average*>& all() const { return all_; }

 protected:
  ~Averages() = default;

 private:
  std::uint64_t count_ = 0;
  std::vector<const Average*> all_;
};

/// Study of a closed chain by such an observer, which is constructed from the parameters.
template <std::derived_from<Averages> Observer>
Study closed_averages(const ClosedParameters& parameters, const std::string& target) {
  validate(parameters);
  ClosedTallies tallies;
  const ScalarTally count = tallies.tally("count", "1", "Events");
  std::vector<ScalarTally> columns;
  Group group;
  for (const Observer prototype(parameters); const Averages::Average* each : prototype.all()) {
    const ScalarTally sum = columns.emplace_back(tallies.tally(each->name, each->units, each->description));
    group.quantity(each->name, each->units, each->description, [=, divisor = each->divisor](TallyMeans mean) {
      return mean[sum] / divisor.value_or(mean[count]);
    });
  }
  const auto observe = [=](ClosedRun& run, TallySums& sums) {
    Observer observer(parameters);
    run.observe(observer);
    sums[count] = static_cast<double>(observer.counted());
    for (std::size_t i = 0; i < columns.size(); ++i) sums[columns[i]] = observer.all()[i]->total();
  };
  return closed_study(parameters, tallies, observe, {group}, target);
}

/// main() of a program of such a study.
template <std::derived_from<Averages> Observer>
int run_closed_averages(int argc, char** argv, const std::string& name, const std::string& description,
                        const std::string& target) {
  StudyProgram program(name, description);
  ClosedParameters parameters;
  declare(program.options(), parameters);
  return program.run(argc, argv, [&] { return closed_averages<Observer>(parameters, target); });
}

}  // namespace lorentz
