#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "statistics/tally.hpp"

namespace lorentz {

/// Number of control variates that were fitted to a quantity, 0 if none was used, and the number of replicas
/// that they need.
struct ControlVariates {
  std::size_t used = 0;
  std::size_t needed = 0;
};

/// Estimates of a described array.
struct Quantity {
  Description what;
  std::vector<double> mean, standard_error;  // 0: all replicas agree; if computed: discretisation error
  std::vector<std::int64_t> count{};         // replicas that contribute; empty if computed
  std::optional<ControlVariates> control_variates{};
};

using Results = std::vector<Quantity>;

/// The quantity of this name, which the results have.
const Quantity& quantity_named(const Results& results, std::string_view name);

/// Values and their standard errors, of the same length. An undefined error is NaN.
struct Estimates {
  std::vector<double> mean;
  std::vector<double> standard_error;
};

/// f of the mean record with its leave-one-out jackknife error over replicas (Efron & Stein, Ann. Stat. 9,
/// 586 (1981)), se^2 = (R-1)/R sum_r (f_(r) - mean of f_(r))^2 [eq. 45]. Valid for independent replicas and
/// smooth f. The bias of f, of order 1/R, is not corrected; se^2 is biased upwards. With fewer than two
/// replicas the error is NaN.
Estimates jackknife(const Records& records, const std::function<std::vector<double>(TallyMeans)>& f);

/// Quantities that are estimated together: from one preparation of the records, by one jackknife. Quantities
/// without control variates thus need a group of their own. Descriptions exist before any record does
/// (--describe).
class Group {
 public:
  /// Records to which the formulas are applied: a part or a transformation of the measured ones, or these
  /// corrected by control variates.
  struct Prepared {
    Records records;
    std::optional<ControlVariates> control_variates{};
  };
  using Prepare = std::function<Prepared(const Records&)>;

  /// Formulas of the mean record.
  using Number = std::function<double(TallyMeans)>;
  using Array = std::function<std::vector<double>(TallyMeans)>;

  /// Without `prepare` the formulas are applied to the records as measured.
  explicit Group(Prepare prepare = {}) : prepare_(std::move(prepare)) {}

  void quantity(std::string_view name, std::string_view units, std::string_view description, Number formula);
  void quantity(std::string_view name, const std::vector<Axis>& axes, std::string_view units,
                std::string_view description, Array formula);
  /// The mean of a tally, with its name, axes, units and description.
  void quantity(const TallySchema& schema, Tally tally);

  /// Several quantities with a common formula, which is chosen when the records are known and returns their
  /// values one after another.
  void quantities(const std::vector<Description>& descriptions,
                  std::function<Array(const Records&)> formula_for);

  /// Quantities with their own errors instead of those of the jackknife, one after another.
  void statistics(const std::vector<Description>& descriptions,
                  std::function<Estimates(const Records&)> estimate);

  std::vector<Description> descriptions() const;

  /// The same quantities of the records as measured.
  Group without_control_variates() const {
    Group plain = *this;
    plain.prepare_ = {};
    return plain;
  }

  /// Throws std::logic_error if a formula gives more or fewer values than described.
  Results estimate(const Records& measured) const;

 private:
  template <class Function>
  struct Part {
    std::vector<Description> what;
    std::function<Function(const Records&)> of;
  };
  Prepare prepare_;
  std::vector<Part<Array>> formulas_;
  std::vector<Part<Estimates>> statistics_;
};

/// Formula of a quantity that is the mean of a tally divided by `divisor`.
Group::Array mean_of(Tally tally, double divisor = 1);

}  // namespace lorentz
