#include "observables/conductivity/hotelling.hpp"

#include <gsl/gsl_cdf.h>

#include <limits>
#include <numeric>

#include "statistics/control_variates.hpp"

namespace lorentz {

double zero_mean_p_value(const Records& records, const Columns& columns, std::size_t fitted) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (records.size() < 2) return none;
  const auto rows = static_cast<double>(records.size());
  const std::vector<std::vector<double>> x = standardised(records, columns);
  std::vector<double> mean;
  std::vector<std::vector<double>> x_centred;
  for (const std::vector<double>& column : x) {
    mean.push_back(std::accumulate(column.begin(), column.end(), 0.0) / rows);
    x_centred.push_back(centred(column));
  }
  const PseudoInverse inverse = inverse_of_products(x_centred);  // of the covariance, over rows - 1
  const auto rank = static_cast<double>(inverse.rank);
  const double records_left = rows - static_cast<double>(fitted);
  if (rank == 0 || records_left <= rank) return none;
  double t_squared = 0;
  for (std::size_t i = 0; i < mean.size(); ++i)
    for (std::size_t j = 0; j < mean.size(); ++j)
      t_squared += rows * (rows - 1) * mean[i] * inverse.elements[i][j] * mean[j];
  return gsl_cdf_fdist_Q(t_squared * (records_left - rank) / (rank * (records_left - 1)), rank,
                         records_left - rank);
}

}  // namespace lorentz
