#include "engine/open_start.hpp"

#include <gsl/gsl_sf_expint.h>

#include <algorithm>
#include <cmath>

#include "engine/random.hpp"

namespace lorentz {
namespace {

/// A half-Gaussian stream of particles through a piece of the chain.
class Stream {
 public:
  /// flight: mean length of a flight.
  Stream(const Reservoir& source, double flight, double age)
      : source_(source), thermal_(std::sqrt(source.temperature)), slow_(slowest(flight, age)) {}

  /// Expected number of particles per unit length. Where F(p) is flat, below the speed slow_ = flight/age,
  /// the density F(p)/slow_ holds as much as F(0).
  double density() const { return source_.rate / thermal_ * std::sqrt(2 / std::numbers::pi) * (1 + fast()); }

  double draw_speed(RandomStream& stream) const {
    if (stream.uniform() * (1 + fast()) < 1) return slow_ * stream.uniform();
    // Density exp(-u^2/2T)/u: rejection from 1/u.
    for (;;) {
      const double u = slow_ * std::pow(fastest * thermal_ / slow_, stream.uniform());
      if (stream.uniform() < std::exp(-0.5 * u * u / source_.temperature)) return u;
    }
  }

 private:
  static constexpr double fastest = 9;  // thermal speeds

  /// Never so fast that F is not flat below.
  double slowest(double flight, double age) const { return std::min(flight / age, 0.1 * thermal_); }

  /// Integral of exp(-u^2/2T)/u from slow_ on.
  double fast() const { return 0.5 * gsl_sf_expint_E1(0.5 * slow_ * slow_ / source_.temperature); }

  Reservoir source_;
  double thermal_, slow_;
};

std::uint64_t poisson(double mean, RandomStream& stream) {
  std::uint64_t count = 0;
  for (double sum = stream.exponential(); sum < mean; sum += stream.exponential()) ++count;
  return count;
}

}  // namespace

PhasePoint empty_start(const OpenChain& chain) { return {{}, std::vector<double>(chain.cells, 0)}; }

PhasePoint local_equilibrium_start(const OpenChain& chain, const Reservoir& left, const Reservoir& right,
                                   double age, std::uint64_t seed, std::uint64_t replica) {
  const double flight =
      chain.cell_length * (chain.deterministic() ? 1 : chain.cells / std::max(chain.gamma, 1.0));
  RandomStream stream(seed, Purpose::initial_chain, replica);
  PhasePoint start;
  for (std::uint32_t cell = 0; cell < chain.cells; ++cell) {
    const double x = (cell + 0.5) / chain.cells;
    const double rate = std::lerp(left.rate, right.rate, x);
    const double power = std::lerp(left.rate * left.temperature, right.rate * right.temperature, x);
    const double temperature = rate > 0 ? power / rate : std::lerp(left.temperature, right.temperature, x);
    const Stream particles({rate, temperature}, flight, age);
    for (const double direction : {1., -1.}) {
      for (auto left_over = poisson(particles.density() * chain.cell_length, stream); left_over > 0;
           --left_over) {
        const double position = (cell + stream.uniform()) * chain.cell_length;
        start.particles.push_back({position, direction * particles.draw_speed(stream)});
      }
    }
    start.scatterers.push_back(std::sqrt(temperature) * stream.gaussian());
  }
  return start;
}

}  // namespace lorentz
