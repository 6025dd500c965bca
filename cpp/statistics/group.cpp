#include "statistics/group.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "numerics/summation.hpp"

namespace lorentz {
namespace {

std::size_t size_of(const std::vector<Description>& descriptions) {
  std::size_t size = 0;
  for (const Description& what : descriptions) size += what.size();
  return size;
}

/// Appends the described quantities, whose values follow one another from `at` on, which is moved past them.
void append(Results& results, const std::vector<Description>& descriptions, const Estimates& estimate,
            std::size_t& at, std::int64_t replicas, const std::optional<ControlVariates>& control_variates) {
  for (const Description& what : descriptions) {
    const auto begin = static_cast<std::ptrdiff_t>(at),
               end = begin + static_cast<std::ptrdiff_t>(what.size());
    results.push_back({what,
                       {estimate.mean.begin() + begin, estimate.mean.begin() + end},
                       {estimate.standard_error.begin() + begin, estimate.standard_error.begin() + end},
                       std::vector<std::int64_t>(what.size(), replicas),
                       control_variates});
    at += what.size();
  }
}

}  // namespace

const Quantity& quantity_named(const Results& results, std::string_view name) {
  return *std::ranges::find(results, name, [](const Quantity& quantity) { return quantity.what.name; });
}

Estimates jackknife(const Records& records, const std::function<std::vector<double>(TallyMeans)>& f) {
  const std::vector<double> mean = records.mean();
  const auto replicas = static_cast<double>(records.size());
  Estimates estimate{f(mean), {}};
  const std::size_t quantities = estimate.mean.size();
  if (records.size() < 2) {
    estimate.standard_error.assign(quantities, std::numeric_limits<double>::quiet_NaN());
    return estimate;
  }

  // Compensated sums of scaled numbers: where only one replica contributes to a sum, the sum without it is
  // exactly 0, and no ratio of rounding errors occurs.
  std::vector<double> scale(mean.size(), 0);
  for (std::size_t replica = 0; replica < records.size(); ++replica)
    for (std::size_t i = 0; i < mean.size(); ++i)
      scale[i] = std::max(scale[i], std::abs(records[replica][i]));
  for (double& factor : scale) factor = towards_one(factor);
  std::vector<CompensatedSum> sums(mean.size());
  for (std::size_t replica = 0; replica < records.size(); ++replica)
    for (std::size_t i = 0; i < mean.size(); ++i) sums[i].add(scale[i] * records[replica][i]);

  // Welford's algorithm is stable if the leave-one-out values differ in their last digits only. It
  // accumulates the root of the sum of squares, because squares of large or small numbers overflow or
  // underflow.
  std::vector<double> centre(quantities, 0), roots(quantities, 0), without(mean.size());
  for (std::size_t replica = 0; replica < records.size(); ++replica) {
    for (std::size_t i = 0; i < mean.size(); ++i)
      without[i] = sums[i].without(scale[i] * records[replica][i]) / (replicas - 1) / scale[i];
    const std::vector<double> value = f(without);
    for (std::size_t k = 0; k < quantities; ++k) {
      const double deviation = value[k] - centre[k];
      centre[k] += deviation / static_cast<double>(replica + 1);
      roots[k] =
          std::hypot(roots[k], std::sqrt(std::abs(deviation)) * std::sqrt(std::abs(value[k] - centre[k])));
    }
  }
  for (const double root_of_squares : roots)
    estimate.standard_error.push_back(std::sqrt((replicas - 1) / replicas) * root_of_squares);
  return estimate;
}

void Group::quantity(std::string_view name, std::string_view units, std::string_view description,
                     Number formula) {
  quantity(name, {}, units, description,
           [formula = std::move(formula)](TallyMeans mean) { return std::vector{formula(mean)}; });
}

void Group::quantity(std::string_view name, const std::vector<Axis>& axes, std::string_view units,
                     std::string_view description, Array formula) {
  quantities({{std::string(name), std::string(units), std::string(description), axes}},
             [formula = std::move(formula)](const Records&) { return formula; });
}

void Group::quantity(const TallySchema& schema, Tally tally) {
  const Description& what = schema.description(tally);
  quantity(what.name, what.axes, what.units, what.description, mean_of(tally));
}

void Group::quantities(const std::vector<Description>& descriptions,
                       std::function<Array(const Records&)> formula_for) {
  formulas_.push_back({descriptions, std::move(formula_for)});
}

void Group::statistics(const std::vector<Description>& descriptions,
                       std::function<Estimates(const Records&)> estimate) {
  statistics_.push_back({descriptions, std::move(estimate)});
}

std::vector<Description> Group::descriptions() const {
  std::vector<Description> all;
  for (const auto& part : formulas_) all.insert(all.end(), part.what.begin(), part.what.end());
  for (const auto& part : statistics_) all.insert(all.end(), part.what.begin(), part.what.end());
  return all;
}

Results Group::estimate(const Records& measured) const {
  std::optional<Prepared> prepared;
  if (prepare_) prepared.emplace(prepare_(measured));
  const Records& records = prepared ? prepared->records : measured;
  const auto control_variates = prepared ? prepared->control_variates : std::nullopt;

  std::vector<Array> formulas;
  for (const auto& part : formulas_) formulas.push_back(part.of(records));
  const Estimates all = jackknife(records, [&](TallyMeans mean) {
    std::vector<double> values;
    for (std::size_t i = 0; i < formulas.size(); ++i) {
      const std::vector<double> more = formulas[i](mean);
      if (more.size() != size_of(formulas_[i].what))
        throw std::logic_error("the formula of " + formulas_[i].what.front().name +
                               " has another size than its axes");
      values.insert(values.end(), more.begin(), more.end());
    }
    return values;
  });
  const auto replicas = static_cast<std::int64_t>(records.size());
  Results results;
  std::size_t at = 0;
  for (const auto& part : formulas_) append(results, part.what, all, at, replicas, control_variates);
  for (const auto& part : statistics_) {
    at = 0;
    append(results, part.what, part.of(records), at, replicas, control_variates);
  }
  return results;
}

Group::Array mean_of(Tally tally, double divisor) {
  return [=](TallyMeans mean) {
    std::vector<double> values(mean[tally].begin(), mean[tally].end());
    for (double& value : values) value /= divisor;
    return values;
  };
}

}  // namespace lorentz
