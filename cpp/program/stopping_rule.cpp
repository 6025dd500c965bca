#include "program/stopping_rule.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>

namespace lorentz {

std::uint64_t StoppingRule::next_look(std::uint64_t used) const {
  const std::uint64_t batches = used / batch;
  const std::uint64_t wanted =
      used == 0 ? (least + batch - 1) / batch : batches + std::max<std::uint64_t>(1, batches / 8);
  return batch * std::max(batches + 1, std::min(wanted, most / batch));
}

bool StoppingRule::reached(std::uint64_t used, double excess) {
  const auto freedom = static_cast<double>(used - 1);
  return used >= least && excess * std::sqrt(freedom / gsl_cdf_chisq_Qinv(0.95, freedom)) <= 1;  // [eq. 48]
}

}  // namespace lorentz
