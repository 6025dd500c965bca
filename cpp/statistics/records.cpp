#include "statistics/records.hpp"

#include <gsl/gsl_statistics_double.h>

#include <stdexcept>

namespace lorentz {

void Records::append(std::span<const double> row) {
  if (row.size() != width_) throw std::invalid_argument("a record of another width");
  rows_.insert(rows_.end(), row.begin(), row.end());
}

std::vector<double> Records::mean() const {
  std::vector<double> result;
  result.reserve(width_);
  for (std::size_t column = 0; column < width_; ++column)
    result.push_back(gsl_stats_mean(rows_.data() + column, width_, size()));
  return result;
}

}  // namespace lorentz
