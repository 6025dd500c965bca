#include "boltzmann/kinetic_equation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace kinetic_equation_test {

using namespace lorentz;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

KineticProblem problem(double sigma, double gamma, std::size_t cells = 0) {
  KineticProblem result;
  result.sigma = sigma;
  result.gamma = gamma;
  result.cells = cells;
  return result;
}

/// Fluxes at the ends, and those of the particles that arrive at the first and the last scatterer.
struct Ends {
  Flux left, right, first, last;

  Ends(const KineticProblem& problem, const KineticSolution& solution)
      : left(solution.at(0)),
        right(solution.at(1)),
        first(problem.cells > 0 ? solution.at_scatterer(0) : left),
        last(problem.cells > 0 ? solution.at_scatterer(problem.cells - 1) : right) {}
};

Ends solve(const KineticProblem& problem, std::size_t order = 96) {
  return {problem, KineticSolution(problem, order)};
}

/// Computed with Fourier transforms on panels of momenta and wave numbers, and GMRES, to at least 9 digits.
struct Reference {
  double sigma, gamma;
  std::size_t cells;
  double particle_current, energy_current, jump, flux;  // at x = 0; flux at p = -10.5
  double first_temperature, last_temperature, kappa;
};

const std::vector<Reference> references{
    {0.3, 1, 0, 32.2641764, -1751.36242, 4.36249591, 8.36856956, 96.8831545, 103.239821, none},
    {0.3, 10, 0, 13.4875859, -818.178887, 1.6040427, 9.17267945, 88.2422963, 113.427412, none},
    {0.3, 2, 2, 24.7640594, -1498.30434, 2.53956783, 8.46616171, 96.8733132, 103.191662, 474.270826},
    {0.3, 3, 3, 21.4893398, -1330.74472, 2.16598329, 8.61656502, 94.8491733, 105.40485, 378.207305},
    {0.3, 1, 3, 31.611896, -1739.64754, 4.10827215, 8.35943781, 97.7602331, 102.289622, 1152.2399},
    {0.3, 1, 7, 32.0004263, -1746.47098, 4.26151919, 8.36508253, 97.2445016, 102.844928, 2182.92244},
    {0.3, 12, 12, 10.2851576, -657.01058, 1.06744056, 9.29750553, 87.924746, 113.769251, 305.060083},
    {0.3, 1, 20, 32.1742965, -1749.67191, 4.32835334, 8.36741439, 97.0073168, 103.103598, 5740.12821},
    {0.3, 20, 20, 7.07078931, -451.771823, 0.748880457, 9.49530547, 85.977522, 116.346815, 297.51883},
    {0.3, 30, 30, 5.08486153, -324.837875, 0.545629969, 9.61281975, 84.7919909, 117.968465, 293.736346},
    {0.5, 1, 0, 28.6217015, -1496.43948, 4.37385139, 8.65203358, 94.7860599, 105.519514, none},
    {0.5, 10, 0, 8.26665328, -448.561811, 1.31489214, 9.56434041, 85.4630263, 117.042937, none},
    {0.5, 2, 2, 17.3810691, -985.00724, 2.40795937, 9.03972298, 94.7324208, 105.469803, 183.472506},
    {0.5, 3, 3, 13.7032906, -780.853397, 1.92937289, 9.23502893, 91.8621893, 108.762282, 138.612273},
    {0.5, 1, 3, 27.4099118, -1449.80007, 4.11334611, 8.67504135, 96.1369953, 104.004135, 552.856625},
    {0.5, 1, 7, 28.1331275, -1477.43253, 4.26994811, 8.66172702, 95.3308836, 104.901337, 1080.62045},
    {0.5, 12, 12, 4.74240168, -270.806739, 0.707104606, 9.6873023, 85.1722832, 117.359416, 100.96211},
    {0.5, 1, 20, 28.455477, -1489.94334, 4.33866557, 8.65539295, 94.9714273, 105.308124, 2882.82295},
    {0.5, 20, 20, 2.99944165, -171.289483, 0.452608458, 9.76618369, 83.9248744, 119.12068, 97.3351686},
    {0.5, 30, 30, 2.05523621, -117.375887, 0.312155718, 9.80737701, 83.2563122, 120.087262, 95.6064567},
    {-0.5, 1, 0, 29.4582406, -1572.4459, 4.42394251, 8.58768273, 95.3492967, 104.902346, none},
    {-0.5, 10, 0, 9.27328142, -525.445624, 1.39918372, 9.4895032, 86.0193718, 116.306955, none},
    {-0.5, 2, 2, 19.1417759, -1135.41681, 2.54132905, 8.91287761, 95.3015702, 104.84406, 237.97076},
    {-0.5, 3, 3, 15.5124469, -928.892762, 2.07137444, 9.10155156, 92.620872, 107.885339, 182.559813},
    {-0.5, 1, 3, 28.39295, -1538.5782, 4.17955424, 8.60352289, 96.5815989, 103.526886, 664.585138},
    {-0.5, 1, 7, 29.0284926, -1558.54187, 4.32636573, 8.59439692, 95.8492069, 104.338005, 1285.19878},
    {-0.5, 12, 12, 5.8048979, -349.270139, 0.807789291, 9.61345482, 85.7269497, 116.623674, 135.653269},
    {-0.5, 1, 20, 29.3119752, -1567.67809, 4.39088068, 8.59001616, 95.5198408, 104.708854, 3412.07064},
    {-0.5, 20, 20, 3.7318574, -224.540806, 0.524582792, 9.71644709, 84.312648, 118.590887, 131.010701},
    {-0.5, 30, 30, 2.58012765, -155.24385, 0.364732379, 9.77222714, 83.5357878, 119.699129, 128.78554},
    {0.8, 1, 0, 24.7457916, -1182.64382, 4.34142057, 9.03219182, 92.3902754, 108.214019, none},
    {0.8, 10, 0, 5.56604279, -258.569418, 1.11902107, 9.75835167, 84.057293, 118.947326, none},
    {0.8, 2, 2, 9.41752131, -375.823242, 2.13755956, 9.74676984, 92.3438303, 108.143748, 47.57281},
    {0.8, 3, 3, 6.82028862, -271.952811, 1.58519242, 9.80135861, 89.2575927, 111.786289, 36.2141877},
    {0.8, 1, 3, 22.5007424, -1053.88866, 4.0649668, 9.15269687, 94.1021772, 106.250616, 260.252861},
    {0.8, 1, 7, 23.8585102, -1132.06349, 4.23084151, 9.07932829, 93.0617154, 107.433728, 551.380267},
    {0.8, 12, 12, 1.95809696, -78.1524758, 0.475273988, 9.87420831, 83.8668287, 119.079931, 26.6329757},
    {0.8, 1, 20, 24.4465922, -1165.63075, 4.3039473, 9.04801863, 92.6159391, 107.950249, 1520.29107},
    {0.8, 20, 20, 1.19860117, -47.8538044, 0.292897996, 9.88224261, 83.0643242, 120.283892, 25.7143255},
    {0.8, 30, 30, 0.807228177, -32.2339473, 0.197946888, 9.88603086, 82.6547194, 120.911587, 25.2769893},
};

// Detected mistakes: sigma or gamma differ by 1e-5; the sign of sigma; a scatterer's own gain arrives at it.
TEST(KineticEquation, AgreesWithAnotherMethod) {
  for (const Reference& expected : references) {
    const KineticProblem p = problem(expected.sigma, expected.gamma, expected.cells);
    const Ends ends = solve(p, expected.sigma < 0.4 && expected.sigma > 0 ? 256 : 96);
    const double top = 1.3 * 220 / std::sqrt(p.left.temperature), sigma = expected.sigma;
    const auto close = [&](double computed, double reference, double tolerance, const char* what) {
      EXPECT_LT(std::abs(computed - reference), tolerance)
          << what << " sigma " << sigma << " gamma " << expected.gamma << " cells " << expected.cells;
    };
    close(ends.left.particle_current(), expected.particle_current, 7e-5, "particle current");
    close(ends.left.energy_current(), expected.energy_current, 2e-4, "energy current");
    close(ends.left.jump(), expected.jump, 3e-6 * top, "jump");
    close(ends.left.left.density(10.5), expected.flux, 1e-6 * top, "flux");
    const double first = ends.first.scatterer_temperature(sigma),
                 last = ends.last.scatterer_temperature(sigma);
    close(first, expected.first_temperature, 1e-7 * first, "first temperature");
    close(last, expected.last_temperature, 1e-7 * last, "last temperature");
    if (expected.cells > 0) {
      const double kappa = -ends.left.energy_current() * static_cast<double>(p.cells) / (last - first);
      close(kappa, expected.kappa, 5e-6 * kappa, "kappa");
    }
  }
}

/// Position of a bond of a chain with 3 cells.
double bond(std::size_t k) { return static_cast<double>(k) / 3; }

// What arrives at a scatterer crosses the adjacent bonds, by quadrature over momenta. Detected mistake: a
// scatterer's own gain arrives at it.
TEST(KineticEquation, TemperaturesFollowFromTheFluxAtAdjacentBonds) {
  for (const double gamma : {3.0, 1.7}) {
    const KineticSolution solution(problem(0.5, gamma, 3), 48);
    for (std::size_t site = 0; site < 3; ++site) {
      const HalfFlux right = solution.at(bond(site)).right, left = solution.at(bond(site + 1)).left;
      double number = 0, momentum = 0, square = 0;
      for (double p = 0.01; p < 150; p += 0.02) {
        const double r = right.density(p), l = left.density(p);
        number += r + l, momentum += p * (r - l), square += p * p * (r + l);
      }
      const double particles = square / number,
                   scatterer = particles + 2 * (momentum / number) * (momentum / number);
      const Flux arriving = solution.at_scatterer(site);
      EXPECT_NEAR(arriving.particle_temperature(), particles, 1e-5 * particles) << site;
      EXPECT_NEAR(arriving.scatterer_temperature(0.5), scatterer, 1e-5 * scatterer) << site;
    }
  }
}

TEST(KineticEquation, ExchangeOfTheBathsMirrorsTheChain) {
  KineticProblem p = problem(0.5, 3, 3);
  const KineticSolution solution(p, 48);
  std::swap(p.left, p.right);
  const KineticSolution mirrored(p, 48);
  for (std::size_t site = 0; site < 3; ++site)
    EXPECT_NEAR(solution.at_scatterer(site).scatterer_temperature(0.5),
                mirrored.at_scatterer(2 - site).scatterer_temperature(0.5), 1e-9);
  for (std::size_t k = 0; k <= 3; ++k) {
    const Flux flux = solution.at(bond(k)), mirror = mirrored.at(bond(3 - k));
    EXPECT_NEAR(flux.energy_current(), -mirror.energy_current(), 1e-8);
    EXPECT_NEAR(flux.right.density(7), mirror.left.density(7), 1e-10);
  }
}

// Currents of number, momentum and energy do not depend on x [eq. 38], also where the series is coarse,
// without scattering, and with one bath.
TEST(KineticEquation, CurrentsAreConstant) {
  KineticProblem one_bath = problem(0.5, 1);
  one_bath.left.rate = 0;
  for (const auto& p : {problem(0.3, 7, 7), problem(-0.7, 4, 11), problem(0.6, 30), problem(0.5, 0),
                        problem(0.5, 1e-10), one_bath}) {
    const KineticSolution solution(p, 20);
    const auto pressure = [](const Flux& flux) { return flux.right.moment(1) + flux.left.moment(1); };
    const Flux first = solution.at(0);
    for (int k = 1; k <= 7; ++k) {
      const Flux flux = solution.at(k / 7.);
      EXPECT_NEAR(flux.particle_current(), first.particle_current(), 1e-11 * 400);
      EXPECT_NEAR(flux.energy_current(), first.energy_current(), 1e-11 * 20'000);
      EXPECT_NEAR(pressure(flux), pressure(first), 1e-11 * 4'000);
    }
  }
}

// Momenta are exchanged at sigma = 0, so that either half of F is that of its bath.
TEST(KineticEquation, IsExactAtSigma0) {
  for (const auto& p : {problem(0, 50), problem(0, 3, 3)})
    for (const Flux& flux : {solve(p, 8).left, solve(p, 8).right, solve(p, 8).first})
      for (const double momentum : {0.0, 3.0, 40.0}) {
        const HalfFlux left{p.left, 1, {}}, right{p.right, 1, {}};
        EXPECT_DOUBLE_EQ(flux.right.density(momentum), left.density(momentum));
        EXPECT_DOUBLE_EQ(flux.left.density(momentum), right.density(momentum));
      }
}

TEST(KineticEquation, EquilibriumStays) {
  for (const double sigma : {-0.99, -0.5, 1e-3, 0.0, 0.2, 0.99})
    for (const double gamma : {0.0, 1.0, 300.0}) {
      KineticProblem p = problem(sigma, gamma);
      p.left = p.right = {200, 100};
      const HalfFlux bath{p.left, 1, {}};
      const Flux flux = KineticSolution(p, 24).at(0.3);
      for (const double momentum : {0.0, 3.0, 40.0})
        for (const HalfFlux& half : {flux.left, flux.right})
          EXPECT_NEAR(half.density(momentum), bath.density(momentum), 1e-10) << sigma << ' ' << gamma;
      EXPECT_LT(std::abs(flux.particle_current()), 1e-10);
    }
}

// The derivative of G at a Maxwellian has the eigenvalues of eq. 40. Detected mistake: those of -sigma.
TEST(CollisionOperator, DerivativeHasTheEigenvaluesOfHermiteFunctions) {
  constexpr std::size_t order = 9;
  for (const double sigma : {-0.7, 0.5}) {
    const CollisionOperator collision(sigma, order);
    for (std::size_t n = 0; n < order; ++n) {
      constexpr double step = 1e-4;
      std::vector<double> more(order), less(order);
      more[0] = less[0] = 1;
      more[n] += step, less[n] -= step;
      const std::vector<double> above = collision.gain(more), below = collision.gain(less);
      const auto k = static_cast<double>(n);
      const double expected =
          n == 0 ? 1 : std::pow(-sigma, k) + std::pow(1 - sigma * sigma, k) / (1 - std::pow(sigma, k));
      for (std::size_t m = 0; m < order; ++m)
        EXPECT_NEAR((above[m] - below[m]) / (2 * step), m == n ? expected : 0, 1e-7) << sigma << ' ' << n;
    }
  }
}

// Number, momentum and energy, of any flux.
TEST(CollisionOperator, Conserves) {
  const std::vector<double> f{2, 0.7, -0.4, 0.3, 0.2}, gain = CollisionOperator(0.6, 5).gain(f);
  for (std::size_t n = 0; n < 3; ++n) EXPECT_NEAR(gain[n], f[n], 1e-14);
  EXPECT_GT(std::abs(gain[3] - f[3]), 0.1);
}

}  // namespace kinetic_equation_test
