#include "observables/conductivity/hotelling.hpp"

#include <gsl/gsl_cdf.h>

#include <limits>

#include "statistics/standardised.hpp"

namespace lorentz {

double zero_mean_p_value(const Records& records, const Columns& columns, std::size_t fitted) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (records.size() < 2) return none;
  const auto rows = static_cast<double>(records.size());
  const Eigen::MatrixXd x = standardised(records, columns);
  const PseudoInverse inverse = pseudo_inverse(centred(x));
  const auto rank = static_cast<double>(inverse.rank);
  const double records_left = rows - static_cast<double>(fitted);
  if (rank == 0 || records_left <= rank) return none;
  // The inverse of the covariance is rows - 1 times the product of the pseudo-inverse and its transpose.
  const double t_squared = rows * (rows - 1) * (x.colwise().mean() * inverse.matrix).squaredNorm();
  return gsl_cdf_fdist_Q(t_squared * (records_left - rank) / (rank * (records_left - 1)), rank,
                         records_left - rank);
}

}  // namespace lorentz
