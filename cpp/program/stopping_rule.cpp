#include "program/stopping_rule.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>

namespace lorentz {
namespace {

/// Number above which a chi-square variable has the given probability. GSL's iteration fails from 5*10^4
/// degrees of freedom on; the approximation of Wilson & Hilferty (PNAS 17, 684 (1931)) is accurate to 5e-8
/// from 10^4 on.
double chi_square_quantile(double probability_above, double freedom) {
  if (freedom < 1e4) return gsl_cdf_chisq_Qinv(probability_above, freedom);
  const double variance = 2 / (9 * freedom);
  const double root = 1 - variance + gsl_cdf_ugaussian_Qinv(probability_above) * std::sqrt(variance);
  return freedom * root * root * root;
}

/// Upper confidence bound at a probability of the standard error of `used` normal records, relative to its
/// estimate [eq. 52].
double bound(std::uint64_t used, double probability) {
  const auto freedom = static_cast<double>(used - 1);
  return std::sqrt(freedom / chi_square_quantile(probability, freedom));
}

}  // namespace

std::uint64_t StoppingRule::next_look(std::uint64_t used) const {
  const std::uint64_t batches = used / batch;
  const std::uint64_t wanted =
      used == 0 ? (least + batch - 1) / batch : batches + std::max<std::uint64_t>(1, batches / 8);
  return batch * std::max(batches + 1, std::min(wanted, most / batch));
}

bool StoppingRule::reached(std::uint64_t used, double excess) {
  return used >= least && excess * bound(used, 0.95) <= 1;
}

StoppingRule::Forecast StoppingRule::forecast(std::uint64_t used, double excess) const {
  return {end(used, excess), end(used, excess * bound(used, 0.025)), end(used, excess * bound(used, 0.975))};
}

std::uint64_t StoppingRule::end(std::uint64_t used, double excess) const {
  std::uint64_t look = used;
  do look = next_look(look);
  while (look + batch <= most &&
         !reached(look, excess * std::sqrt(static_cast<double>(used) / static_cast<double>(look))));
  return look;
}

}  // namespace lorentz
