#pragma once

#include <Eigen/Core>
#include <vector>

namespace lorentz {

/// Matrices from the values of a function at the nodes to its Fourier integrals; one row per k.
struct FourierIntegrals {
  Eigen::MatrixXd cosine;            // int f(p) cos(k p) dp
  Eigen::MatrixXd cosine_minus_one;  // int f(p) (cos(k p) - 1) dp, to full relative precision
  Eigen::MatrixXd sine;              // int f(p) sin(k p) dp
};

/// Piecewise polynomials on adjacent panels, represented by their values at the Gauss-Legendre nodes of every
/// panel. Linear operations on them are matrices, exact for such functions, with one row per point and one
/// column per node.
class Panels {
 public:
  /// Breaks ascend; `order` nodes on every panel.
  Panels(std::vector<double> breaks, int order);

  const Eigen::VectorXd& nodes() const { return nodes_; }
  const Eigen::VectorXd& weights() const { return weights_; }  // of the Gauss quadrature
  Eigen::Index size() const { return nodes_.size(); }
  int order() const { return order_; }
  double end() const { return breaks_.back(); }

  /// Panel of a point; the last one for points beyond the end.
  std::size_t panel(double point) const;

  /// Weights of Lagrange interpolation: the sum of the values at the panel's nodes times these is the value
  /// at the point.
  Eigen::VectorXd lagrange(std::size_t panel, double point) const;

  /// Matrix to the values at points; 0 beyond the end.
  Eigen::MatrixXd interpolation(const Eigen::VectorXd& points) const;

  /// Matrix to the integrals from the beginning to the points.
  Eigen::MatrixXd integration(const Eigen::VectorXd& points) const;

  /// Integrals over all panels by Filon's rule, whose accuracy does not depend on k.
  FourierIntegrals fourier(const Eigen::VectorXd& k) const;

 private:
  double middle(std::size_t panel) const { return 0.5 * (breaks_[panel] + breaks_[panel + 1]); }
  double half_width(std::size_t panel) const { return 0.5 * (breaks_[panel + 1] - breaks_[panel]); }
  Eigen::Index first(std::size_t panel) const { return static_cast<Eigen::Index>(panel) * order_; }
  std::size_t count() const { return breaks_.size() - 1; }

  std::vector<double> breaks_;
  int order_;
  Eigen::VectorXd nodes_, weights_;
  Eigen::MatrixXd legendre_;  // from values at the nodes to Legendre coefficients, on one panel
};

/// Breaks 0 and `largest` ratio^-n, n = ..., 1, 0, the first of them at most `smallest`: a grid that resolves
/// structure near 0 on every scale.
std::vector<double> graded_breaks(double smallest, double largest, double ratio);

}  // namespace lorentz
