#include "statistics/jackknife.hpp"

#include <cmath>
#include <limits>

namespace lorentz {

Estimate jackknife(const Records& records, const RecordFunction& f) {
  const std::vector<double> mean = records.mean();
  const auto replicas = static_cast<double>(records.size());
  Estimate estimate{f(mean), {}};
  const std::size_t quantities = estimate.mean.size();
  if (records.size() < 2) {
    estimate.standard_error.assign(quantities, std::numeric_limits<double>::quiet_NaN());
    return estimate;
  }

  // Extended precision: where only one replica contributes to a sum, the sum without it is exactly 0, and no
  // ratio of rounding errors occurs.
  std::vector<long double> sums(mean.size(), 0);
  for (std::size_t replica = 0; replica < records.size(); ++replica)
    for (std::size_t i = 0; i < mean.size(); ++i) sums[i] += records[replica][i];

  // Welford's algorithm is stable if the leave-one-out values differ in their last digits only. It
  // accumulates the root of the sum of squares, because squares of large or small numbers overflow or
  // underflow.
  std::vector<double> centre(quantities, 0), root(quantities, 0), without(mean.size());
  for (std::size_t replica = 0; replica < records.size(); ++replica) {
    for (std::size_t i = 0; i < mean.size(); ++i)
      without[i] = static_cast<double>((sums[i] - records[replica][i]) / (replicas - 1));
    const std::vector<double> value = f(without);
    for (std::size_t k = 0; k < quantities; ++k) {
      const double deviation = value[k] - centre[k];
      centre[k] += deviation / static_cast<double>(replica + 1);
      root[k] =
          std::hypot(root[k], std::sqrt(std::abs(deviation)) * std::sqrt(std::abs(value[k] - centre[k])));
    }
  }
  for (const double each : root)
    estimate.standard_error.push_back(std::sqrt((replicas - 1) / replicas) * each);
  return estimate;
}

}  // namespace lorentz
