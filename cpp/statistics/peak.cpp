#include "statistics/peak.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/NonLinearOptimization>

namespace lorentz {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double part_of_maximum = 0.5;   // level of the window
constexpr double least_half_width = 2.5;  // in cells

std::vector<double> running_mean(const std::vector<double>& profile) {
  std::vector<double> means;
  for (std::size_t d = 0; d < profile.size(); ++d) {
    const auto half = static_cast<std::size_t>(std::lround(0.06 * static_cast<double>(d)));
    const std::size_t first = d - half, last = std::min(d + half, profile.size() - 1);
    double sum = 0;
    for (std::size_t cell = first; cell <= last; ++cell) sum += profile[cell];
    means.push_back(sum / static_cast<double>(last - first + 1));
  }
  return means;
}

/// Residuals sqrt(weight) (exp(c0 + c1 u + c2 u^2 + c3 u^3) - y) of every cell, in the form of Eigen's
/// Levenberg-Marquardt algorithm.
struct ExpCubic {
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  Eigen::MatrixX4d powers;  // of u
  Eigen::VectorXd root_weight, y;

  static int inputs() { return 4; }
  int values() const { return static_cast<int>(y.size()); }
  Eigen::VectorXd weighted(const Eigen::VectorXd& c) const {
    return (powers * c).array().exp().matrix().cwiseProduct(root_weight);
  }
  int operator()(const Eigen::VectorXd& c, Eigen::VectorXd& residuals) const {
    residuals = weighted(c) - y.cwiseProduct(root_weight);
    return 0;
  }
  int df(const Eigen::VectorXd& c, Eigen::MatrixXd& jacobian) const {
    jacobian = weighted(c).asDiagonal() * powers;
    return 0;
  }
};

}  // namespace

std::vector<double> folded(std::span<const double> profile) {
  const std::size_t centre = profile.size() / 2;
  std::vector<double> result{profile[centre]};
  for (std::size_t d = 1; d <= centre; ++d)
    result.push_back(0.5 * (profile[centre - d] + profile[(centre + d) % profile.size()]));
  return result;
}

std::vector<double> odd_part(std::span<const double> profile) {
  const std::size_t centre = profile.size() / 2;
  std::vector<double> result;
  for (std::size_t d = 1; centre + d < profile.size(); ++d)
    result.push_back(0.5 * (profile[centre + d] - profile[centre - d]));
  return result;
}

std::optional<PeakWindow> peak_window(const std::vector<double>& profile) {
  const std::vector<double> y = running_mean(profile);
  const auto top = static_cast<std::size_t>(std::max_element(y.begin() + 1, y.end()) - y.begin());
  const double level = part_of_maximum * y[top];
  if (!(level > 0)) return {};
  std::size_t low = top, high = top;
  while (low > 0 && y[low] > level) --low;
  while (high < y.size() - 1 && y[high] > level) ++high;
  if (y[low] > level || y[high] > level) return {};
  // Linear interpolation between the outermost cell above the level and its neighbour.
  const double left = static_cast<double>(low) + (level - y[low]) / (y[low + 1] - y[low]);
  const double right = static_cast<double>(high) - (level - y[high]) / (y[high - 1] - y[high]);
  return PeakWindow{0.5 * (left + right), std::max(0.5 * (right - left), least_half_width)};
}

Peak fit_peak(const std::vector<double>& profile, const PeakWindow& window) {
  const auto last_cell = static_cast<double>(profile.size() - 1);
  const auto first = static_cast<Eigen::Index>(std::ceil(std::max(0.0, window.middle - window.half_width)));
  const auto last =
      static_cast<Eigen::Index>(std::floor(std::min(last_cell, window.middle + window.half_width)));
  const Eigen::Index size = last - first + 1;
  if (size < 4) return {none, none};

  const Eigen::VectorXd y =
      Eigen::Map<const Eigen::VectorXd>(&profile[static_cast<std::size_t>(first)], size);
  const double scale = y.maxCoeff();
  if (!(scale > 0)) return {none, none};
  const Eigen::ArrayXd u =
      (Eigen::ArrayXd::LinSpaced(size, static_cast<double>(first), static_cast<double>(last)) -
       window.middle) /
      window.half_width;
  ExpCubic fit{{size, 4}, (1 - u.square()).max(0).sqrt(), y / scale};
  fit.powers << Eigen::ArrayXd::Ones(size), u, u.square(), u.cube();
  Eigen::VectorXd c = Eigen::Vector4d(0, 0, std::log(part_of_maximum), 0);
  Eigen::LevenbergMarquardt solver(fit);
  solver.parameters.ftol = solver.parameters.xtol = 1e-12;  // well below the differences of jackknife samples
  solver.minimize(c);

  // Maximum of the cubic p(u): p'(u) = 0 and p''(u) < 0, in the form without cancellation.
  const double root = std::sqrt(c[2] * c[2] - 3 * c[1] * c[3]);
  const double top = c[1] / (root - c[2]);
  if (!(std::abs(top) < 1)) return {none, none};
  const double height = std::exp(c[0] + top * (c[1] + top * (c[2] + top * c[3])));
  return {window.middle + window.half_width * top, scale * height};
}

}  // namespace lorentz
