#include "statistics/hotelling.hpp"

#include <gsl/gsl_cdf.h>

#include <limits>

#include "statistics/standardised.hpp"

namespace lorentz {

double zero_mean_p_value(const Records& records, const Columns& columns, std::size_t fitted) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const auto rows = static_cast<Eigen::Index>(records.size());
  if (rows < 2) return none;
  const Eigen::Map<const Matrix> all(records.values().data(), rows,
                                     static_cast<Eigen::Index>(records.width()));
  const Matrix x = standardised(all(Eigen::all, columns));
  const Eigen::VectorXd mean = x.colwise().mean().transpose();
  const Matrix centred = x.rowwise() - x.colwise().mean();
  const auto covariance = (centred.transpose() * centred / static_cast<double>(rows - 1))
                              .eval()
                              .completeOrthogonalDecomposition();
  const auto rank = static_cast<double>(covariance.rank());
  const double records_left = static_cast<double>(rows) - static_cast<double>(fitted);
  if (rank == 0 || records_left <= rank) return none;
  const double t_squared = static_cast<double>(rows) * mean.dot(covariance.solve(mean));
  return gsl_cdf_fdist_Q(t_squared * (records_left - rank) / (rank * (records_left - 1)), rank,
                         records_left - rank);
}

}  // namespace lorentz
