#pragma once

#include <Eigen/Core>
#include <vector>

namespace lorentz {

/// Matrices that take the values of a function at the nodes to its Fourier integrals, one row for each k.
struct FourierIntegrals {
  Eigen::MatrixXd cosine;            // int f(p) cos(k p) dp
  Eigen::MatrixXd cosine_minus_one;  // int f(p) (cos(k p) - 1) dp, to full relative precision
  Eigen::MatrixXd sine;
};

/// Piecewise polynomials on adjacent panels, given by their values at the Gauss-Legendre nodes of every
/// panel. Everything linear that is done to them is a matrix, exact for such functions: rows are points,
/// columns nodes.
class Panels {
 public:
  /// Breaks ascend; `order` nodes on every panel.
  Panels(std::vector<double> breaks, int order);

  const Eigen::VectorXd& nodes() const { return nodes_; }
  const Eigen::VectorXd& weights() const { return weights_; }  // of the Gauss quadrature
  Eigen::Index size() const { return nodes_.size(); }
  int order() const { return order_; }
  double begin() const { return breaks_.front(); }
  double end() const { return breaks_.back(); }

  /// The panel that a point belongs to; the last one beyond the end.
  std::size_t panel(double point) const;

  /// Values at the nodes of the point's panel times these weights add up to the value at the point.
  Eigen::VectorXd lagrange(std::size_t panel, double point) const;

  /// Values at points; 0 beyond the end.
  Eigen::MatrixXd interpolation(const Eigen::VectorXd& points) const;

  /// Integrals from the beginning to the points.
  Eigen::MatrixXd integration(const Eigen::VectorXd& points) const;

  /// Filon's rule: the integrals over all panels, however large k is.
  FourierIntegrals fourier(const Eigen::VectorXd& k) const;

 private:
  double middle(std::size_t panel) const { return 0.5 * (breaks_[panel] + breaks_[panel + 1]); }
  double half_width(std::size_t panel) const { return 0.5 * (breaks_[panel + 1] - breaks_[panel]); }
  Eigen::Index first(std::size_t panel) const { return static_cast<Eigen::Index>(panel) * order_; }
  std::size_t count() const { return breaks_.size() - 1; }

  std::vector<double> breaks_;
  int order_;
  Eigen::VectorXd nodes_, weights_;
  Eigen::MatrixXd legendre_;  // values at the nodes to Legendre coefficients, on one panel
};

/// 0, smallest, then growing by `ratio` until `largest` is reached: resolves what happens near 0 on every
/// scale.
std::vector<double> graded_breaks(double smallest, double largest, double ratio);

}  // namespace lorentz
