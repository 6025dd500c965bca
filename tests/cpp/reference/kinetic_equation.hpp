#pragma once

#include <gsl/gsl_integration.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

/// Independent solution of the Boltzmann equation in real space [eq. 36], without shared code: collision
/// integrals by quadrature split at the discontinuity of F; g from its balance equation; Chebyshev-Lobatto
/// collocation in x; fixed-point iteration with Anderson acceleration. Small and slow.
namespace reference {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Function on [-reach, reach], discontinuous at 0, given by its values at the Gauss nodes of equal panels.
class Line {
 public:
  static constexpr int order = 16;

  Line(double reach, Index panels_on_a_half)
      : panels_(2 * panels_on_a_half), reach_(reach), nodes_(panels_ * order), weights_(nodes_.size()) {
    gsl_integration_glfixed_table* const table = gsl_integration_glfixed_table_alloc(order);
    for (Index i = 0; i < order; ++i)
      gsl_integration_glfixed_point(-1, 1, static_cast<std::size_t>(i), &rule_[i], &rule_weights_[i], table);
    gsl_integration_glfixed_table_free(table);
    for (Index i = 0; i < order; ++i) {
      barycentric_[i] = 1;
      for (Index j = 0; j < order; ++j)
        if (j != i) barycentric_[i] /= rule_[i] - rule_[j];
    }
    for (Index panel = 0; panel < panels_; ++panel) {
      nodes_.segment(panel * order, order) = begin(panel) + 0.5 * width() * (1 + rule_.array());
      weights_.segment(panel * order, order) = 0.5 * width() * rule_weights_;
    }
  }

  const VectorXd& nodes() const { return nodes_; }
  const VectorXd& weights() const { return weights_; }

  /// Weights of g at the nodes in the integral of f((a v - b)/d) g(v) dv, split at v = b/a, where f is
  /// discontinuous.
  VectorXd kernel(const VectorXd& f, double a, double b, double d) const {
    VectorXd row = VectorXd::Zero(nodes_.size());
    for (Index panel = 0; panel < panels_; ++panel) {
      const double low = begin(panel), high = low + width(), jump = b / a;
      if (low < jump && jump < high)
        for (const auto& [from, to] : {std::pair(low, jump), std::pair(jump, high)})
          for (Index i = 0; i < order; ++i) {
            const double v = from + 0.5 * (to - from) * (1 + rule_[i]);
            row.segment(panel * order, order) +=
                0.5 * (to - from) * rule_weights_[i] * value(f, (a * v - b) / d) * lagrange(panel, v);
          }
      else
        for (Index i = panel * order; i < (panel + 1) * order; ++i)
          row[i] = weights_[i] * value(f, (a * nodes_[i] - b) / d);
    }
    return row;
  }

  double value(const VectorXd& f, double at) const {
    if (std::abs(at) >= reach_) return 0;
    const Index panel = std::clamp<Index>(static_cast<Index>((at + reach_) / width()), 0, panels_ - 1);
    return lagrange(panel, at).dot(f.segment(panel * order, order));
  }

 private:
  double width() const { return 2 * reach_ / static_cast<double>(panels_); }
  double begin(Index panel) const { return width() * static_cast<double>(panel - panels_ / 2); }

  using Weights = Eigen::Matrix<double, order, 1>;

  Weights lagrange(Index panel, double at) const {
    const double place = 2 * (at - begin(panel)) / width() - 1;
    Weights weights = Weights::Zero();
    for (Index i = 0; i < order; ++i) {
      if (place == rule_[i]) return Weights::Unit(i);
      weights[i] = barycentric_[i] / (place - rule_[i]);
    }
    return weights / weights.sum();
  }

  Index panels_;
  double reach_;
  VectorXd nodes_, weights_;
  VectorXd rule_ = VectorXd(order), rule_weights_ = VectorXd(order), barycentric_ = VectorXd(order);
};

class KineticEquation {
 public:
  struct Bath {
    double rate, temperature;
  };

  KineticEquation(double sigma, double gamma, Bath left, Bath right, Index panels, Index sites)
      : line_(9.5 * std::sqrt(std::max(left.temperature, right.temperature)), panels),
        sigma_(sigma),
        c_(std::sqrt(1 - sigma * sigma)),
        gamma_(gamma),
        left_(bath(left)),
        right_(bath(right)),
        x_(sites),
        streaming_(sites, sites) {
    const auto last = static_cast<double>(sites - 1);
    for (Index i = 0; i < sites; ++i)
      x_[i] = 0.5 - 0.5 * std::cos(std::numbers::pi * static_cast<double>(i) / last);
    const auto scale = [&](Index i) { return (i % 2 == 0 ? 1 : -1) * (i == 0 || i == sites - 1 ? 2. : 1.); };
    for (Index i = 0; i < sites; ++i)
      for (Index j = 0; j < sites; ++j) streaming_(i, j) = i == j ? 0 : scale(i) / scale(j) / (x_[i] - x_[j]);
    streaming_.diagonal() = -streaming_.rowwise().sum();
  }

  const Line& line() const { return line_; }
  const VectorXd& x() const { return x_; }

  /// Solves J g(U) = 1/c int dU' F((U - sigma U')/c) g(U') with int g = 1 for g.
  VectorXd scatterer(const VectorXd& flux) const {
    const Index size = flux.size();
    MatrixXd balance(size, size);
    const double scale = c_ * line_.weights().dot(flux);
    for (Index i = 0; i < size; ++i)
      balance.row(i) = line_.kernel(flux, sigma_, line_.nodes()[i], -c_).transpose() / scale;
    balance.diagonal().array() -= 1;
    balance.row(size / 2) = line_.weights().transpose();  // replaces one redundant equation
    return balance.partialPivLu().solve(VectorXd::Unit(size, size / 2));
  }

  /// G(u) = 1/|sigma| int dv F((c v - u)/sigma) g(v), v = c u + sigma U.
  VectorXd gain(const VectorXd& flux, const VectorXd& g) const {
    VectorXd result(flux.size());
    for (Index i = 0; i < flux.size(); ++i)
      result[i] = line_.kernel(flux, c_, line_.nodes()[i], sigma_).dot(g) / std::abs(sigma_);
    return result;
  }

  /// F at the nodes of the line, one column per x.
  MatrixXd solve(double tolerance = 1e-13, int limit = 200) const {
    const Index half = line_.nodes().size() / 2, sites = x_.size();
    MatrixXd flux(2 * half, sites);
    flux.topRows(half) = right_.reverse().replicate(1, sites);
    flux.bottomRows(half) = left_.replicate(1, sites);
    std::vector<VectorXd> points, changes;
    for (int step = 0; step < limit; ++step) {
      const VectorXd point = flux.reshaped(), change = VectorXd(iterated(flux).reshaped()) - point;
      if (change.cwiseAbs().maxCoeff() < tolerance * point.maxCoeff()) return flux;
      points.push_back(point);
      changes.push_back(change);
      flux = accelerated(points, changes).reshaped(2 * half, sites);
    }
    throw std::runtime_error("the reference solution did not converge");
  }

 private:
  VectorXd bath(const Bath& bath) const {
    const Index half = line_.nodes().size() / 2;
    return bath.rate * std::sqrt(2 / (std::numbers::pi * bath.temperature)) *
           (-line_.nodes().tail(half).array().square() / (2 * bath.temperature)).exp();
  }

  /// Solves sign(p) dF/dx + gamma F = gamma G with the gain of the flux given.
  MatrixXd iterated(const MatrixXd& flux) const {
    const Index half = flux.rows() / 2, sites = x_.size();
    MatrixXd next(flux.rows(), sites);
    for (Index at = 0; at < sites; ++at) next.col(at) = gamma_ * gain(flux.col(at), scatterer(flux.col(at)));
    MatrixXd right = streaming_, left = -streaming_;
    right.diagonal().array() += gamma_;
    left.diagonal().array() += gamma_;
    right.row(0) = VectorXd::Unit(sites, 0).transpose();
    left.row(sites - 1) = VectorXd::Unit(sites, sites - 1).transpose();
    next.col(0).tail(half) = left_;
    next.col(sites - 1).head(half) = right_.reverse();
    next.bottomRows(half) = right.partialPivLu().solve(next.bottomRows(half).transpose()).transpose().eval();
    next.topRows(half) = left.partialPivLu().solve(next.topRows(half).transpose()).transpose().eval();
    return next;
  }

  /// Anderson acceleration: the combination of the latest iterates with the least residual.
  static VectorXd accelerated(const std::vector<VectorXd>& points, const std::vector<VectorXd>& changes) {
    const std::size_t last = points.size() - 1, depth = std::min<std::size_t>(last, 25);
    VectorXd next = points[last] + changes[last];
    if (depth == 0) return next;
    MatrixXd differences(next.size(), static_cast<Index>(depth)), moves = differences;
    for (std::size_t i = 0; i < depth; ++i) {
      const auto column = static_cast<Index>(i);
      differences.col(column) = changes[last - i] - changes[last - i - 1];
      moves.col(column) = points[last - i] - points[last - i - 1];
    }
    return next - (moves + differences) * differences.colPivHouseholderQr().solve(changes[last]);
  }

  Line line_;
  double sigma_, c_, gamma_;
  VectorXd left_, right_;  // at the nodes p > 0
  VectorXd x_;
  MatrixXd streaming_;  // d/dx
};

}  // namespace reference
