#include "statistics/correlation_coefficient.hpp"

#include <gsl/gsl_statistics_double.h>

#include <cmath>
#include <limits>

namespace lorentz {

Estimator correlation_coefficient(const Description& what, ScalarTally one, ScalarTally other,
                                  const Correction& correction) {
  return {{what}, [=](const Records& records) {
            const auto [corrected, control_variates] = correction(records);
            const double* const values = corrected.values().data();
            const std::size_t width = corrected.width(), count = corrected.size();
            const double found =
                gsl_stats_correlation(values + one.column, width, values + other.column, width, count);
            const double r = std::abs(found) <= 1 ? found : std::numeric_limits<double>::quiet_NaN();
            const double error = (1 - r * r) / std::sqrt(static_cast<double>(count) - 1);
            return Results{{what, {r}, {error}, {count}, control_variates}};
          }};
}

}  // namespace lorentz
