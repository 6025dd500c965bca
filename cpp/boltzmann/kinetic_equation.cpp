#include "boltzmann/kinetic_equation.hpp"

#include <gsl/gsl_integration.h>
#include <gsl/gsl_sf_legendre.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace lorentz {
namespace {

using Vector = std::vector<double>;

double parity(std::size_t n) { return n % 2 == 0 ? 1 : -1; }

/// sqrt(w(u)) of the normal density w.
double root_normal(double u) { return std::exp(-0.25 * u * u) / std::pow(2 * std::numbers::pi, 0.25); }

/// h_0(u), ..., h_{size-1}(u) times sqrt(w(u)), so that nothing overflows at large u.
Vector hermite(std::size_t size, double u) {
  Vector h(size, root_normal(u));
  for (std::size_t n = 1; n < size; ++n) {
    const auto m = static_cast<double>(n);
    h[n] = (u * h[n - 1] - (n > 1 ? std::sqrt(m - 1) * h[n - 2] : 0)) / std::sqrt(m);
  }
  return h;
}

/// Integrals of h_n h_m w over u > 0: (n - m) int h_n h_m w = w (h_n h_m' - h_m h_n') between the limits, and
/// h_n' = sqrt(n) h_{n-1}.
Matrix half_line_products(std::size_t rows, std::size_t columns) {
  const Vector h = hermite(std::max(rows, columns), 0);
  const auto slope = [&](std::size_t n) { return n > 0 ? std::sqrt(static_cast<double>(n)) * h[n - 1] : 0; };
  Matrix products(rows, columns);
  for (std::size_t n = 0; n < rows; ++n)
    for (std::size_t m = 0; m < columns; ++m)
      products(n, m) =
          n == m ? 0.5
                 : (h[m] * slope(n) - h[n] * slope(m)) / (static_cast<double>(n) - static_cast<double>(m));
  return products;
}

/// Coefficients of a(scale z).
Vector scaled(Vector a, double scale) {
  double power = 1;
  for (double& value : a) {
    value *= power;
    power *= scale;
  }
  return a;
}

/// Product of two power series, truncated.
Vector product(const Vector& a, const Vector& b) {
  Vector result(a.size());
  for (std::size_t n = 0; n < a.size(); ++n)
    for (std::size_t m = 0; m <= n; ++m) result[n] += a[m] * b[n - m];
  return result;
}

/// Mean temperature of the baths that inject. T_b < 2T, as the series requires.
double mean_temperature(const Reservoir& left, const Reservoir& right) {
  return 0.5 * ((left.rate > 0 ? left : right).temperature + (right.rate > 0 ? right : left).temperature);
}

/// Momenta are exchanged at sigma = 0, so that G = F, and either half of F is that of its bath.
KineticProblem without_exchange(KineticProblem problem) {
  if (problem.sigma == 0) problem.gamma = 0;  // exactly 0: for any other sigma, G differs from F
  return problem;
}

/// Number of scatterers, or of nodes that resolve the boundary layers of width 1/gamma.
std::size_t number_of_sites(const KineticProblem& problem, std::size_t order) {
  if (problem.cells > 0) return problem.cells;
  const double refinement = std::sqrt(static_cast<double>(order) / 10);
  return static_cast<std::size_t>(std::ceil((3 + 2 * std::sqrt(problem.gamma)) * refinement));
}

/// Largest magnitude; NaN if one value is NaN.
double largest(const Matrix& matrix) {
  const gsl_matrix_const_view view = matrix.view();
  double lowest = 0, highest = 0;
  gsl_matrix_minmax(&view.matrix, &lowest, &highest);  // both NaN if one value is
  return std::max(-lowest, highest);
}

}  // namespace

CollisionOperator::CollisionOperator(double sigma, std::size_t order) : sigma_(sigma), unit_(order, 1) {
  const auto size = static_cast<double>(order);
  for (std::size_t n = 1; n < order; ++n)
    unit_[n] = unit_[n - 1] * std::sqrt(size / (std::numbers::e * static_cast<double>(n)));
}

Vector CollisionOperator::gain(std::span<const double> f) const {
  constexpr double negligible = 1e-17;  // sigma^j: the other factors differ from 1 by less than rounding
  Vector series(f.begin(), f.end());
  for (std::size_t n = 0; n < series.size(); ++n) series[n] *= unit_[n];
  Vector q = scaled(series, (1 - sigma_) * (1 + sigma_));
  for (double& value : q) value /= f[0];
  // By doubling, q_{2m}(z) = q_m(z) q_m(sigma^m z).
  for (double scale = sigma_; std::abs(scale) > negligible; scale *= scale) q = product(q, scaled(q, scale));
  Vector result = product(scaled(series, -sigma_), q);
  for (std::size_t n = 0; n < result.size(); ++n) result[n] /= unit_[n];
  return result;
}

double HalfFlux::density(double p) const {
  const double unit = std::sqrt(temperature), t = bath.temperature;
  const Vector h = hermite(a.size(), p / unit);
  double sum = 0;
  for (std::size_t m = 0; m < a.size(); ++m) sum += a[m] * h[m];
  return bath.rate * std::sqrt(2 / (std::numbers::pi * t)) * std::exp(-p * p / (2 * t)) +
         root_normal(p / unit) * sum / unit;
}

/// The integral of w h_m is -w h_{m-1}/sqrt(m).
double HalfFlux::integral(double p) const {
  const double u = p / std::sqrt(temperature), at_u = root_normal(u), at_0 = root_normal(0);
  const Vector h = hermite(a.size(), u), start = hermite(a.size(), 0);
  double sum = bath.rate * std::erf(p / std::sqrt(2 * bath.temperature)) +
               0.5 * a[0] * std::erf(u / std::numbers::sqrt2);
  for (std::size_t m = 1; m < a.size(); ++m)
    sum += a[m] * (at_0 * start[m - 1] - at_u * h[m - 1]) / std::sqrt(static_cast<double>(m));
  return sum;
}

Vector HalfFlux::hermite_moments(std::size_t size) const {
  const double t = bath.temperature / temperature;
  const double height = bath.rate * std::sqrt(2 * t / std::numbers::pi) / root_normal(0);
  const Vector start = hermite(size, 0);
  const Matrix products = half_line_products(size, a.size());
  Vector result(size, bath.rate);  // of the bath, by integration by parts
  for (std::size_t n = 1; n < size; ++n) {
    const auto m = static_cast<double>(n);
    const double inner = n > 1 ? (t - 1) * std::sqrt(m - 1) * result[n - 2] : 0;
    result[n] = (height * start[n - 1] + inner) / std::sqrt(m);
  }
  for (std::size_t n = 0; n < size; ++n)
    for (std::size_t m = 0; m < a.size(); ++m) result[n] += products(n, m) * a[m];
  return result;
}

double HalfFlux::moment(std::size_t n) const {
  const Vector m = hermite_moments(5);
  const double square = std::numbers::sqrt2 * m[2] + m[0];  // u^2 = sqrt(2) h_2 + 1
  const double fourth = std::sqrt(24.) * m[4] + 6 * square - 3 * m[0];
  if (n == 0) return m[0];
  if (n == 1) return std::sqrt(temperature) * m[1];
  return n == 2 ? temperature * square : temperature * temperature * fourth;
}

double HalfFlux::kurtosis() const {
  const double value = moment(4) * moment(0) / (moment(2) * moment(2));
  return std::isfinite(value) ? value : std::numeric_limits<double>::quiet_NaN();
}

double Flux::integral(double low, double high) const {
  return low < 0 ? left.integral(-low) - left.integral(-high) : right.integral(high) - right.integral(low);
}

double Flux::particle_temperature() const {
  return (right.moment(2) + left.moment(2)) / (right.moment(0) + left.moment(0));
}

double Flux::scatterer_temperature(double sigma) const {
  const double mean = (right.moment(1) - left.moment(1)) / (right.moment(0) + left.moment(0));
  const double mass = (1 + sigma) / (1 - sigma);
  return particle_temperature() + (mass - 1) * mean * mean;
}

KineticSolution::KineticSolution(const KineticProblem& problem, std::size_t order,
                                 const KineticSolution* guess, const std::function<void(double)>& on_step)
    : problem_(without_exchange(problem)),
      temperature_(mean_temperature(problem.left, problem.right)),
      order_(order),
      x_(number_of_sites(problem_, order)),
      weight_(x_.size(), 1 / static_cast<double>(x_.size())),
      collision_(problem.sigma, order),
      right_{1, problem.left},
      left_{-1, problem.right},
      gain_(x_.size(), order) {
  const GslObject<gsl_integration_glfixed_table, gsl_integration_glfixed_table_alloc,
                  gsl_integration_glfixed_table_free>
      table(x_.size());
  for (std::size_t j = 0; j < x_.size(); ++j)
    if (problem_.cells > 0)
      x_[j] = (static_cast<double>(j) + 0.5) * weight_[j];
    else
      gsl_integration_glfixed_point(0, 1, j, &x_[j], &weight_[j], table.get());
  prepare(right_);
  prepare(left_);
  if (guess && guess->x_.size() == x_.size() && guess->modes() == modes()) jacobian_ = guess->jacobian_;
  iterate(first_guess(guess), on_step);
  set_net_gain(right_);
  set_net_gain(left_);
}

/// With the loss, F_i = F_bath + gamma sum_j passed_ij (G_j - F_j) has the solution (1 + gamma passed)^-1
/// (F_bath + gamma passed G), the same for every |p|.
void KineticSolution::prepare(Direction& direction) const {
  const std::size_t count = x_.size();
  Matrix loss(count, count);
  direction.gain = Matrix(count, count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vector passed = passed_to_site(i, direction.sign);
    for (std::size_t j = 0; j < count; ++j) {
      direction.gain(j, i) = problem_.gamma * passed[j];  // transposed: a right-hand side is a row
      loss(i, j) = problem_.gamma * passed[j] + (i == j ? 1 : 0);
    }
  }
  const LuFactors factors(std::move(loss));
  for (std::size_t j = 0; j < count; ++j) factors.solve(direction.gain.row(j));
  direction.gain = transposed(direction.gain);
  direction.rest.assign(count, 1);
  factors.solve(direction.rest);

  direction.products = half_line_products(order_, order_);
  direction.injected = HalfFlux{direction.bath, temperature_, {}}.hermite_moments(order_);
  if (direction.sign > 0) return;
  for (std::size_t n = 0; n < order_; ++n) {
    direction.injected[n] *= parity(n);
    for (std::size_t m = 0; m < order_; ++m) direction.products(n, m) *= parity(n + m);
  }
}

/// Weights of the sites that particles of a direction have passed on their way to x; in the continuum, the
/// integrals of the Lagrange polynomials of the nodes over this way. That of node j is weight_j sum_k (2k +
/// 1) P_k(t_j) P_k(t) with Legendre polynomials of t = 2x - 1, and 2k + 1 times the integral of P_k from -1
/// to t is P_{k+1} - P_{k-1}, with P_{-1} = -1.
Vector KineticSolution::passed(double x, double sign) const {
  const std::size_t count = x_.size();
  Vector passed(count);
  if (problem_.cells > 0) {
    for (std::size_t j = 0; j < count; ++j) passed[j] = (x_[j] < x) == (sign > 0) ? weight_[j] : 0;
    return passed;
  }
  Vector at_x(count + 1), at_node(count + 1);
  gsl_sf_legendre_Pl_array(static_cast<int>(count), 2 * x - 1, at_x.data());
  for (std::size_t j = 0; j < count; ++j) {
    gsl_sf_legendre_Pl_array(static_cast<int>(count), 2 * x_[j] - 1, at_node.data());
    for (std::size_t k = 0; k < count; ++k)
      passed[j] += 0.5 * weight_[j] * at_node[k] * (at_x[k + 1] - (k > 0 ? at_x[k - 1] : -1));
    if (sign < 0) passed[j] = weight_[j] - passed[j];
  }
  return passed;
}

Vector KineticSolution::passed_to_site(std::size_t site, double sign) const {
  Vector passed = this->passed(x_[site], sign);
  if (problem_.cells > 0) passed[site] = 0;  // a scatterer's own gain does not arrive at it [eq. 39]
  return passed;
}

Flux KineticSolution::at(double x) const { return {half(right_, passed(x, 1)), half(left_, passed(x, -1))}; }

Flux KineticSolution::at_scatterer(std::size_t site) const {
  return {half(right_, passed_to_site(site, 1)), half(left_, passed_to_site(site, -1))};
}

/// F_bath + sum_j passed_j gamma (G_j - F_j) with the flux F_j that arrives at the sites.
HalfFlux KineticSolution::half(const Direction& direction, const Vector& passed) const {
  HalfFlux result{direction.bath, temperature_, Vector(order_)};
  for (std::size_t j = 0; j < passed.size(); ++j) {
    result.bath.rate -= problem_.gamma * passed[j] * direction.rest[j] * direction.bath.rate;
    for (std::size_t m = 0; m < order_; ++m) result.a[m] += passed[j] * direction.net_gain(j, m);
  }
  return result;
}

/// f_n at the sites: those of the guess, or the solution if every collision reversed the momentum, G(p) =
/// F(-p).
Matrix KineticSolution::first_guess(const KineticSolution* guess) const {
  Matrix f(x_.size(), order_);
  for (std::size_t i = 0; i < f.rows(); ++i) {
    if (guess) {
      const Flux flux = problem_.cells > 0 ? guess->at_scatterer(i) : guess->at(x_[i]);
      const Vector right = flux.right.hermite_moments(guess->order_),
                   left = flux.left.hermite_moments(guess->order_);
      for (std::size_t n = 0; n < guess->order_; ++n) f(i, n) = right[n] + parity(n) * left[n];
      continue;
    }
    const double from_left = problem_.gamma * (1 - x_[i]) / (1 + problem_.gamma),
                 from_right = problem_.gamma * x_[i] / (1 + problem_.gamma);
    for (std::size_t n = 0; n < order_; ++n)
      f(i, n) = (1 - from_right + parity(n) * from_left) * right_.injected[n] +
                (1 - from_left + parity(n) * from_right) * left_.injected[n];
  }
  return f;
}

/// f_n at the sites after streaming with the present gain.
Matrix KineticSolution::image() const {
  Matrix f(x_.size(), order_);
  for (const Direction* direction : {&right_, &left_}) {
    Matrix arriving(f.rows(), order_);
    add_product(direction->gain, gain_, arriving);
    add_product(arriving, direction->products, f);
    for (std::size_t i = 0; i < f.rows(); ++i)
      for (std::size_t n = 0; n < order_; ++n) f(i, n) += direction->rest[i] * direction->injected[n];
  }
  return f;
}

/// Coefficients in Newton's linear system, whose size limits its cost.
std::size_t KineticSolution::modes() const {
  constexpr std::size_t unknowns = 800, least = 4;
  return std::min(order_, std::max(least, unknowns / x_.size()));
}

/// 1 minus the derivative of the image for the lowest modes, by differences of the gain, which does not
/// depend on higher ones.
Matrix KineticSolution::linearised(const Matrix& f) const {
  const std::size_t count = x_.size(), modes = this->modes();
  const CollisionOperator low(problem_.sigma, modes);
  Matrix result(count * modes, count * modes);
  for (std::size_t j = 0; j < count; ++j) {
    Vector shifted(f.row(j).begin(), f.row(j).begin() + static_cast<std::ptrdiff_t>(modes));
    const Vector gain = low.gain(shifted);
    const double step = 1e-6 * f(j, 0);
    for (std::size_t k = 0; k < modes; ++k) {
      const double before = std::exchange(shifted[k], shifted[k] + step);
      const Vector changed = low.gain(shifted);
      shifted[k] = before;
      for (std::size_t n = 0; n < modes; ++n) {
        double right = 0, left = 0;
        for (std::size_t m = k; m < modes; ++m) {
          right += right_.products(n, m) * (changed[m] - gain[m]) / step;
          left += left_.products(n, m) * (changed[m] - gain[m]) / step;
        }
        for (std::size_t i = 0; i < count; ++i)
          result(i * modes + n, j * modes + k) =
              (i == j && n == k ? 1 : 0) - right_.gain(i, j) * right - left_.gain(i, j) * left;
      }
    }
  }
  return result;
}

/// Newton's step of the lowest modes and the fixed-point step of the others.
Matrix KineticSolution::step(const Matrix& f, bool renew_jacobian) {
  const std::size_t count = f.rows(), modes = this->modes();
  for (std::size_t i = 0; i < count; ++i) std::ranges::copy(collision_.gain(f.row(i)), gain_.row(i).begin());
  ++evaluations_;
  Matrix step = image();
  Vector low(count * modes);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t n = 0; n < order_; ++n) step(i, n) -= f(i, n);
    std::ranges::copy(step.row(i).first(modes), &low[i * modes]);
  }
  if (renew_jacobian) jacobian_ = std::make_shared<LuFactors>(linearised(f));
  jacobian_->solve(low);
  for (std::size_t i = 0; i < count; ++i) std::copy_n(&low[i * modes], modes, step.row(i).begin());
  return step;
}

void KineticSolution::iterate(Matrix f, const std::function<void(double)>& on_step) {
  constexpr double rounding = 1e-13;    // step that rounding permits
  constexpr double acceptable = 1e-10;  // step that suffices if steps no longer become smaller
  constexpr double frozen = 1e-2;       // largest step after which the Jacobian is kept
  constexpr double longest = 0.1;       // step that is taken at most
  constexpr int limit = 200;
  const double rates = problem_.left.rate + problem_.right.rate;
  double last = std::numeric_limits<double>::infinity();
  for (bool renew = !jacobian_;; renew = last > frozen) {
    const Matrix change = step(f, renew);
    const double size = largest(change) / rates;
    if (on_step) on_step(size);
    // Of a geometric series of steps; where rounding makes them equal, of 100 more of them.
    iteration_error_ = size / (1 - std::min(size / last, 0.99));
    const bool at_rest = size < rounding || (size < acceptable && size > 0.9 * last);
    if (at_rest) return;
    if (!(size < 1e6) || evaluations_ == limit)
      throw ConvergenceError(
          "Newton's iteration for the Boltzmann equation did not converge, because its steps do not become "
          "smaller; choose baths that differ less, a smaller gamma, or sigma farther from -1, 0 and 1");
    for (std::size_t i = 0; i < f.rows(); ++i)
      for (std::size_t n = 0; n < order_; ++n) f(i, n) += change(i, n) * std::min(1., longest / size);
    last = size;
  }
}

/// gamma (G - F) at the sites, as series in |u|.
void KineticSolution::set_net_gain(Direction& direction) const {
  direction.net_gain = Matrix(gain_.rows(), order_);
  add_product(direction.gain, gain_, direction.net_gain);
  for (std::size_t i = 0; i < gain_.rows(); ++i)
    for (std::size_t m = 0; m < order_; ++m) {
      const double net = problem_.gamma * (gain_(i, m) - direction.net_gain(i, m));
      direction.net_gain(i, m) = direction.sign > 0 ? net : parity(m) * net;
    }
}

}  // namespace lorentz
