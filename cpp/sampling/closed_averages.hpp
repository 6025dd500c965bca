#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sampling/closed_run.hpp"

namespace lorentz {

/// Base of an observer whose quantities are numbers, each a sum over events divided by the number of events
/// or by a constant. A member of type Average declares a quantity; hooks (engine/observation.hpp) add to it.
class Averages {
 public:
  class Average {
   public:
    /// divisor: of the sum; none: the number of calls of count().
    Average(Averages* observer, std::string_view name, std::string_view units, std::string_view description,
            std::optional<double> divisor = {})
        : name_(name), units_(units), description_(description), divisor_(divisor) {
      observer->all_.push_back(this);
    }
    void operator+=(double value) { sum_ += value; }

   private:
    friend class AverageTallies;
    double sum_ = 0;
    std::string_view name_, units_, description_;
    std::optional<double> divisor_;
  };

  Averages() = default;
  Averages(const Averages&) = delete;  // all_ points to members
  Averages& operator=(const Averages&) = delete;

 protected:
  ~Averages() = default;
  void count() { ++count_; }

 private:
  friend class AverageTallies;
  std::uint64_t count_ = 0;
  std::vector<Average*> all_;
};

/// Tallies of an observer's averages.
class AverageTallies : public ClosedTallies {
 public:
  explicit AverageTallies(const Averages& observer) {
    for (const Averages::Average* each : observer.all_)
      sums_.push_back(tally(each->name_, each->units_, "Sum over events of " + std::string(each->name_)));
  }

  void record(const Averages& observer, TallySums& sums) const {
    sums[count_] = static_cast<double>(observer.count_);
    for (std::size_t i = 0; i < sums_.size(); ++i) sums[sums_[i]] = observer.all_[i]->sum_;
  }

  Group group(const Averages& observer) const {
    Group group;
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      const Averages::Average& each = *observer.all_[i];
      group.quantity(each.name_, each.units_, each.description_,
                     [sum = sums_[i], count = count_, divisor = each.divisor_](TallyMeans mean) {
                       return mean[sum] / divisor.value_or(mean[count]);
                     });
    }
    return group;
  }

 private:
  ScalarTally count_ = tally("count", "1", "Events");
  std::vector<ScalarTally> sums_;
};

/// Study of a closed chain by such an observer, which is constructed from the parameters.
template <std::derived_from<Averages> Observer>
Study closed_averages(const ClosedParameters& parameters, const std::string& target) {
  validate(parameters);
  const Observer prototype(parameters);
  const AverageTallies tallies(prototype);
  const auto observe = [=](ClosedRun& run, TallySums& sums) {
    Observer observer(parameters);
    run.observe(observer);
    tallies.record(observer, sums);
  };
  return closed_study(parameters, tallies, observe, {tallies.group(prototype)}, target);
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
