#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>
#include <vector>

#include "reference/arguments.hpp"
#include "reference/heap_simulator.hpp"

namespace reference {

/// Closed chain by the reference simulator, with independent random numbers and initial states and no code
/// shared with the engine or the programs. Particles start with uniform positions and Gaussian momenta,
/// scatterers at rest; cells have length 1. Prints one line per replica: at every time after the relaxation
/// the mean over the particles of x^2 and the square of their mean x; then, over the observation after the
/// relaxation, the number of scatterings, the number with p' p > 0, sums of the energies of particle and
/// scatterer before them, and a histogram, with bins of equal
/// ratio, of the waiting times that begin with these scatterings. The chain runs until every such waiting
/// time has ended or exceeds the last bin. No time exceeds the observation.
struct ClosedChain {
  Arguments of;
  std::size_t cells = of.count("cells"), particles_per_cell = of.count("particles-per-cell"),
              bins = of.count("bins");
  double sigma = of.number("sigma"), gamma = of.number("gamma"), temperature = of.number("temperature"),
         relaxation = of.number("relaxation-time"), observation = of.number("observation-time"),
         first_edge = of.number("first-edge"), bins_per_decade = of.number("bins-per-decade");
  std::vector<double> times = of.list("times");

  double last_edge() const { return first_edge * std::pow(10, static_cast<double>(bins) / bins_per_decade); }
  void run() const {
    for (std::size_t replica = 0; replica < of.count("replicas"); ++replica)
      run_replica(of.count("seed") * 1000003 + replica);
  }
  void run_replica(std::uint64_t generator_seed) const;
};

/// Statistics from the collisions. A displacement is the time integral of the momentum.
class ClosedChainWatch {
 public:
  ClosedChainWatch(const ClosedChain& setting, double scatterer_mass, const std::vector<double>& momenta)
      : setting_(setting), scatterer_mass_(scatterer_mass), counts_(setting.bins, 0) {
    for (const double p : momenta) particles_.push_back({p});
  }

  void see(const HeapSimulator<double>::Event& event) {
    Tagged& particle = particles_[event.particle];
    particle.x = particle.x_at(event.time);
    particle.p = event.p_after;
    particle.since = event.time;

    count_wait(event.time - particle.wait_begin);
    const bool observed =
        event.time >= setting_.relaxation && event.time < setting_.relaxation + setting_.observation;
    particle.wait_begin = observed ? event.time : std::numeric_limits<double>::quiet_NaN();
    scatterings_ += observed ? 1 : 0;
    persistent_ += observed && event.p_before * event.p_after > 0 ? 1 : 0;
    particle_energy_ += observed ? event.p_before * event.p_before / 2 : 0;
    scatterer_energy_ += observed ? event.P_before * event.P_before / (2 * scatterer_mass_) : 0;
  }

  /// Starts the measurement of displacements.
  void begin(double time) {
    for (Tagged& particle : particles_) particle.x -= particle.x_at(time);
  }

  void print_moments(double time) const {
    double square = 0, mean = 0;
    for (const Tagged& particle : particles_) {
      const double x = particle.x_at(time);
      square += x * x;
      mean += x;
    }
    const auto count = static_cast<double>(particles_.size());
    mean /= count;
    std::printf("%.17g %.17g ", square / count, mean * mean);
  }

  void print_counts() const {
    std::printf("%ld %ld %.17g %.17g", scatterings_, persistent_, particle_energy_, scatterer_energy_);
    for (const long count : counts_) std::printf(" %ld", count);
    std::printf("\n");
  }

 private:
  struct Tagged {
    double p, x = 0, since = 0;
    double wait_begin = std::numeric_limits<double>::quiet_NaN();  // NaN: not observed
    double x_at(double time) const { return x + p * (time - since); }
  };

  void count_wait(double wait) {
    const double bin = std::floor(setting_.bins_per_decade * std::log10(wait / setting_.first_edge));
    if (bin >= 0 && bin < static_cast<double>(setting_.bins)) ++counts_[static_cast<std::size_t>(bin)];
  }

  const ClosedChain& setting_;
  double scatterer_mass_;
  std::vector<Tagged> particles_;
  std::vector<long> counts_;
  long scatterings_ = 0, persistent_ = 0;
  double particle_energy_ = 0, scatterer_energy_ = 0;
};

inline void ClosedChain::run_replica(std::uint64_t generator_seed) const {
  std::mt19937_64 generator(generator_seed);
  std::normal_distribution<> gaussian(0, std::sqrt(temperature));
  std::uniform_real_distribution<> uniform;
  std::vector<double> positions, momenta;
  for (std::size_t i = 0; i < cells * particles_per_cell; ++i) {
    positions.push_back(static_cast<double>(i / particles_per_cell) + uniform(generator));
    momenta.push_back(gaussian(generator));
  }
  HeapSimulator<double> chain(sigma, 1, positions, momenta, std::vector<double>(cells, 0));
  chain.scatter_with(gamma / static_cast<double>(cells), generator());
  chain.reverse(of.number("particle-reversal"), of.number("scatterer-reversal"), generator());
  chain.rotate_with(of.number("rotation"), generator());

  ClosedChainWatch watch(*this, chain.scatterer_mass(), momenta);
  const auto run_until = [&](double time) {
    for (HeapSimulator<double>::Event event{}; chain.step(time, event);) watch.see(event);
  };
  run_until(relaxation);
  watch.begin(relaxation);
  for (const double time : times) {
    run_until(relaxation + time);
    watch.print_moments(relaxation + time);
  }
  run_until(relaxation + observation + last_edge());
  watch.print_counts();
}

}  // namespace reference
