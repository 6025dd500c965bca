#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "statistics/control_variates.hpp"
#include "statistics/quantity.hpp"
#include "statistics/tally.hpp"

namespace lorentz {

/// Quantities that are estimated together. Their descriptions exist before any record does (--describe).
struct Estimator {
  std::vector<Description> quantities;
  std::function<Results(const Records&)> estimate;
};

/// Replaces records by records corrected with control variates.
using Correction = std::function<ReducedRecords(const Records&)>;

/// Quantities f(mean record), concatenated in the order of their descriptions, with jackknife errors over
/// replicas [eq. 49]. The error of an array element that is 0 in all replicas is NaN. Throws std::logic_error
/// if f returns more or fewer values than described.
Results estimate(const Records& records, const std::vector<Description>& descriptions,
                 const std::function<std::vector<double>(RecordView)>& f);

/// Formula of a quantity that is the mean of a tally divided by `divisor`.
inline auto mean_of(Tally tally, double divisor = 1) {
  return [=](RecordView mean) {
    std::vector<double> values(mean[tally].begin(), mean[tally].end());
    for (double& value : values) value /= divisor;
    return values;
  };
}

/// Quantities with one formula each. A formula is a function of the mean record, or of a Reading that is
/// computed once from the mean record for all formulas.
template <class Reading = RecordView>
class Formulas {
 public:
  using Read = std::function<Reading(RecordView)>;
  using Number = std::function<double(const Reading&)>;
  using Array = std::function<std::vector<double>(const Reading&)>;

  Formulas()
    requires std::is_same_v<Reading, RecordView>
      : Formulas([](RecordView mean) { return mean; }) {}
  explicit Formulas(Read read) : read_(std::move(read)) {}

  void quantity(const std::string& name, const std::string& units, const std::string& description,
                Number formula) {
    add({name, units, description},
        [formula = std::move(formula)](const Reading& reading) { return std::vector{formula(reading)}; });
  }

  void quantity(const std::string& name, const std::vector<Axis>& axes, const std::string& units,
                const std::string& description, Array formula) {
    add({name, units, description, axes}, std::move(formula));
  }

  const std::vector<Description>& descriptions() const { return descriptions_; }

  /// Estimator with jackknife errors over the records as they are.
  Estimator estimator() const {
    return {descriptions_, [*this](const Records& records) { return estimate(records); }};
  }

  /// The same for transformed records.
  Estimator estimator_of(const std::function<Records(const Records&)>& transform) const {
    return {descriptions_,
            [*this, transform](const Records& records) { return estimate(transform(records)); }};
  }

  /// The same for corrected records; every quantity states whether control variates were used.
  Estimator estimator(const Correction& correction) const {
    return {descriptions_, [*this, correction](const Records& records) {
              const ReducedRecords reduced = correction(records);
              Results results = estimate(reduced.records);
              for (Quantity& quantity : results) quantity.control_variates = reduced.control_variates;
              return results;
            }};
  }

 private:
  void add(Description what, Array formula) {
    descriptions_.push_back(std::move(what));
    formulas_.push_back(std::move(formula));
  }

  Results estimate(const Records& records) const {
    return lorentz::estimate(records, descriptions_, [this](RecordView mean) {
      const Reading reading = read_(mean);
      std::vector<double> values;
      for (std::size_t i = 0; i < formulas_.size(); ++i) {
        const std::vector<double> more = formulas_[i](reading);
        if (more.size() != descriptions_[i].size())
          throw std::logic_error("the formula of " + descriptions_[i].name +
                                 " has another size than its axes");
        values.insert(values.end(), more.begin(), more.end());
      }
      return values;
    });
  }

  Read read_;
  std::vector<Description> descriptions_;
  std::vector<Array> formulas_;
};

}  // namespace lorentz
