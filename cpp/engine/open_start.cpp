#include "engine/open_start.hpp"

#include <gsl/gsl_sf_expint.h>

#include <algorithm>
#include <cmath>

#include "numerics/random.hpp"

namespace lorentz {
namespace {

/// Sampler of the speeds of half-Gaussian particles that have entered for a time, the age [eq. 23].
/// pdf: exp(-v^2/2) / max(v, slow_) up to a factor, v > 0 in units of sqrt(T): a particle slower than one
/// flight per age has accumulated for the age only.
/// Method: composition of v < slow_ and v > slow_. Below, rejection: of a uniform v by exp(-v^2/2), or of a
/// half-Gaussian v beyond slow_ where slow_ > 1. Above, rejection of a log-uniform v by exp(-v^2/2).
/// Validity: age, T > 0; speeds beyond 9 sqrt(T), of probability below 1e-18, are left out.
/// Reference: Devroye, Non-Uniform Random Variate Generation (Springer 1986), sections II.3 and II.4.
class EntryStream {
 public:
  /// flight: mean length of a flight.
  EntryStream(const Reservoir& source, double flight, double age)
      : rate_(source.rate), thermal_(std::sqrt(source.temperature)), slow_(flight / age / thermal_) {}

  /// Expected number of particles per unit length.
  double density() const { return rate_ * (slow_part() + fast_part()) / thermal_; }

  double draw_speed(RandomStream& stream) const {
    const bool slow = stream.uniform() * (slow_part() + fast_part()) < slow_part();
    for (;;) {
      const double v = slow ? slow_candidate(stream) : slow_ * std::pow(fastest / slow_, stream.uniform());
      const bool gaussian_already = slow && slow_ > 1;
      if (gaussian_already ? v < slow_ : stream.uniform() < std::exp(-0.5 * v * v)) return thermal_ * v;
    }
  }

 private:
  static constexpr double fastest = 9;  // in units of the thermal speed, as all speeds here

  double slow_candidate(RandomStream& stream) const {
    return slow_ > 1 ? std::abs(stream.gaussian()) : slow_ * stream.uniform();
  }

  /// Integrals of sqrt(2/pi) exp(-v^2/2) over max(v, slow_), below slow_ and above.
  double slow_part() const { return std::erf(slow_ / std::numbers::sqrt2) / slow_; }
  double fast_part() const {
    return slow_ < fastest ? gsl_sf_expint_E1(0.5 * slow_ * slow_) / std::sqrt(2 * std::numbers::pi) : 0;
  }

  double rate_, thermal_, slow_;
};

std::uint64_t poisson(double mean, RandomStream& stream) {
  std::uint64_t count = 0;
  for (double sum = stream.exponential(); sum < mean; sum += stream.exponential()) ++count;
  return count;
}

}  // namespace

PhasePoint empty_start(const OpenChain& chain) { return {{}, std::vector<double>(chain.cells, 0)}; }

PhasePoint local_equilibrium_start(const OpenChain& chain, const Reservoir& left, const Reservoir& right,
                                   double age, const StreamKey& key) {
  RandomStream stream(key, Purpose::initial_chain, 0);
  PhasePoint start;
  for (std::uint32_t cell = 0; cell < chain.cells; ++cell) {
    const double x = (cell + 0.5) / chain.cells;
    const double rate = std::lerp(left.rate, right.rate, x);
    const double power = std::lerp(left.rate * left.temperature, right.rate * right.temperature, x);
    const double temperature = rate > 0 ? power / rate : std::lerp(left.temperature, right.temperature, x);
    const EntryStream particles({rate, temperature}, chain.free_path(), age);
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
