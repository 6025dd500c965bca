#include "boltzmann/sites.hpp"

namespace lorentz {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Sites Sites::continuum(int nodes) {
  Sites sites;
  sites.interval_.emplace(std::vector<double>{0, 1}, nodes);
  sites.positions_ = sites.interval_->nodes();
  return sites;
}

Sites Sites::chain(int cells) {
  Sites sites;
  sites.positions_ = (VectorXd::LinSpaced(cells, 0, cells - 1).array() + 0.5) / cells;
  return sites;
}

Transport Sites::transport_to(const VectorXd& x) const {
  if (interval_) {
    const MatrixXd from_left = interval_->integration(x);
    return {from_left, (-from_left).rowwise() + interval_->weights().transpose()};
  }
  const Index count = positions_.size();
  Transport transport{MatrixXd::Zero(x.size(), count), MatrixXd::Zero(x.size(), count)};
  for (Index row = 0; row < x.size(); ++row)
    for (Index site = 0; site < count; ++site) {
      if (positions_[site] == x[row]) continue;
      (positions_[site] < x[row] ? transport.from_left : transport.from_right)(row, site) =
          1 / static_cast<double>(count);
    }
  return transport;
}

}  // namespace lorentz
