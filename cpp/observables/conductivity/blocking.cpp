#include "observables/conductivity/blocking.hpp"

#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

namespace lorentz {

bool Blocking::converged() const {
  const std::size_t last = error.size() - 1;
  return last > 0 && std::abs(error[last] - error[last - 1]) <= 3 * uncertainty[last];
}

Blocking blocking(const Records& blocks) {
  if (!std::has_single_bit(blocks.width()))
    throw std::invalid_argument("the number of blocks must be a power of two");
  // Rows are stored one after another, so joining neighbours joins blocks of one replica until one block per
  // replica is left.
  std::vector<double> means = blocks.values();
  double scale = 0;  // largest modulus; dividing by it prevents overflow of the squares
  for (const double mean : means) scale = std::max(scale, std::abs(mean));
  if (scale > 0)
    for (double& mean : means) mean /= scale;
  Blocking result;
  for (std::size_t width = blocks.width();; width /= 2) {
    const auto count = static_cast<double>(means.size());
    const double error = scale * std::sqrt(gsl_stats_variance(means.data(), 1, means.size()) / count);
    result.error.push_back(error);
    result.uncertainty.push_back(error / std::sqrt(2 * (count - 1)));
    if (width == 1) return result;
    for (std::size_t i = 0; i < means.size() / 2; ++i) means[i] = 0.5 * (means[2 * i] + means[2 * i + 1]);
    means.resize(means.size() / 2);
  }
}

}  // namespace lorentz
