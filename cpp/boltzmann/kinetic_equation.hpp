#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

#include "model/reservoir.hpp"
#include "numerics/matrix.hpp"

namespace lorentz {

/// Stationary Boltzmann equation [eq. 35] for the flux F(p, x) on 0 < x < 1 between two baths (m = k_B = 1),
///
///   sign(p) dF/dx = gamma (G - F),   F(p > 0, x = 0) and F(p < 0, x = 1) given [eq. 5],
///
/// or, with `cells` > 0, the mean-field chain [eq. 39]: scatterers that each scatter a particle with
/// probability gamma/cells, with F and the scatterer's density g independent at each.
///
/// F jumps at p = 0, but the gain G is smooth there, and the loss does not depend on p. Let u = p/sqrt(T)
/// with T the mean temperature of the baths, w the normal density and h_m = He_m/sqrt(m!). Then
///
///   G(u, x) = w(u) sum_m G_m(x) h_m(u),   F(+-|u|, x) = rest(x) F_bath(|u|) + w(u) sum_m a_m(x) h_m(|u|):
///
/// on either half line F is the part of the bath's flux that has not been scattered, plus the gain that has
/// streamed to x. G depends on F through the coefficients f_n = int h_n F du alone. The number of
/// coefficients and, in the continuum, of nodes in x are the only discretisation. Near p = 0, G varies over
/// sigma and sqrt(1 - sigma^2) thermal momenta, and coefficients of a bath at T_b fall as (T_b/T - 1)^(m/2):
/// the series converges slowly for sigma near 0 and +-1 and for baths of very different temperatures.
struct KineticProblem {
  double sigma = 0.5;
  double gamma = 1;
  Reservoir left = default_left, right = default_right;
  std::size_t cells = 0;  // 0: continuum
};

/// Newton's iteration did not converge.
struct ConvergenceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The collision [eq. 36]. The Fourier transform of F is exp(-k^2/2) f(-ik) with the power series f(z) =
/// sum_n f_n z^n/sqrt(n!). The exponentials cancel, as (-sigma)^2 + sum_j (c^2 sigma^j)^2 = 1, so that
///
///   G(z) = f(-sigma z) prod_{j>=0} f(c^2 sigma^j z)/J,   J = f_0.
///
/// G_n depends on f_0, ..., f_n only; G_n = f_n for n = 0, 1, 2: number, momentum and energy [eq. 38].
class CollisionOperator {
 public:
  CollisionOperator(double sigma, std::size_t order);
  std::vector<double> gain(std::span<const double> f) const;  // G_n from f_n

 private:
  double sigma_;
  std::vector<double> unit_;  // of z^n, so that 1/sqrt(n!) does not underflow
};

/// Flux on one half line as a function of |p|, 1/(time momentum): that of the bath [eq. 5] with the rate of
/// the particles that have not been scattered, plus w(u)/sqrt(T) sum_m a_m h_m(u), u = |p|/sqrt(T).
struct HalfFlux {
  Reservoir bath;
  double temperature;  // T
  std::vector<double> a;

  double density(double p) const;
  double integral(double p) const;                              // over momenta from 0 to p
  std::vector<double> hermite_moments(std::size_t size) const;  // int h_n(|u|) F dp
  double moment(std::size_t n) const;                           // int |p|^n F dp, n = 0, 1, 2 or 4
  double kurtosis() const;                                      // <p^4>/<p^2>^2; NaN without particles
};

/// F(p) at one position.
struct Flux {
  HalfFlux right, left;  // p > 0, p < 0

  /// p = -0.0 is the limit from below.
  double density(double p) const { return std::signbit(p) ? left.density(-p) : right.density(p); }
  double integral(double low, double high) const;  // over momenta on one side of p = 0
  double particle_current() const { return right.moment(0) - left.moment(0); }        // [eq. 25]
  double energy_current() const { return 0.5 * (right.moment(2) - left.moment(2)); }  // [eq. 25]
  double jump() const { return right.density(0) - left.density(0); }                  // at p = 0
  double particle_temperature() const;                                                // [eq. 26]
  double scatterer_temperature(double sigma) const;                                   // <P^2>/M [eq. 37]
};

/// Solution of a KineticProblem: Newton's method for the lowest coefficients, which contain the conserved
/// quantities, and fixed-point iteration for the others.
class KineticSolution {
 public:
  /// `order`: number of coefficients. `guess`: a solution of the problem at a lower order, from which the
  /// iteration starts. `on_step` is called with the size of every step. Throws ConvergenceError.
  KineticSolution(const KineticProblem& problem, std::size_t order, const KineticSolution* guess = nullptr,
                  const std::function<void(double)>& on_step = {});

  Flux at(double x) const;                    // 0 <= x <= 1; bonds of a chain are at multiples of 1/cells
  Flux at_scatterer(std::size_t site) const;  // chain: the particles that arrive

  int evaluations() const { return evaluations_; }             // of the collision at all sites
  double iteration_error() const { return iteration_error_; }  // of coefficients, relative to the rates

 private:
  /// Particles of one direction. At site i arrives the fraction rest_i of the bath's flux, and the fraction
  /// gain_ij of the gain at site j.
  struct Direction {
    double sign;  // of p
    Reservoir bath;
    std::vector<double> rest{}, injected{};  // injected: f_n of the bath
    Matrix gain{0, 0};
    Matrix products{0, 0};  // int h_n h_m w over the half line
    Matrix net_gain{0, 0};  // gamma (G - F)
  };

  void prepare(Direction& direction) const;
  std::vector<double> passed(double x, double sign) const;
  std::vector<double> passed_to_site(std::size_t site, double sign) const;
  HalfFlux half(const Direction& direction, const std::vector<double>& passed) const;
  std::size_t modes() const;
  Matrix first_guess(const KineticSolution* guess) const;
  Matrix image() const;
  Matrix linearised(const Matrix& f) const;
  Matrix step(const Matrix& f, bool renew_jacobian);
  void iterate(Matrix f, const std::function<void(double)>& on_step);
  void set_net_gain(Direction& direction) const;

  KineticProblem problem_;
  double temperature_;  // T
  std::size_t order_;
  std::vector<double> x_, weight_;  // of sites: N scatterers, or Gauss-Legendre nodes
  CollisionOperator collision_;
  Direction right_, left_;
  Matrix gain_;  // G_n at every site
  std::shared_ptr<const LuFactors> jacobian_;
  int evaluations_ = 0;
  double iteration_error_ = 0;
};

}  // namespace lorentz
