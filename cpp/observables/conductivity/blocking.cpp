#include "observables/conductivity/blocking.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace lorentz {

bool Blocking::converged() const {
  const std::size_t last = error.size() - 1;
  return last > 0 && error[last] - error[last - 1] <= 3 * uncertainty[last];
}

Blocking blocking(const Records& blocks) {
  // Rows are stored one after another, so joining neighbours joins blocks of one replica until one block per
  // replica is left.
  std::vector<double> means = blocks.values();
  Blocking result;
  for (std::size_t width = blocks.width();; width /= 2) {
    const auto count = static_cast<double>(means.size());
    const Eigen::Map<const Eigen::ArrayXd> all(means.data(), static_cast<Eigen::Index>(means.size()));
    const double error = (all - all.mean()).matrix().stableNorm() / std::sqrt(count * (count - 1));
    result.error.push_back(error);
    result.uncertainty.push_back(error / std::sqrt(2 * (count - 1)));
    if (width == 1) return result;
    for (std::size_t i = 0; i < means.size() / 2; ++i) means[i] = 0.5 * (means[2 * i] + means[2 * i + 1]);
    means.resize(means.size() / 2);
  }
}

}  // namespace lorentz
