#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <queue>
#include <random>
#include <vector>

#include "reference/rotation.hpp"

namespace reference {

/// Independent reference implementation of the closed chain for tests and timing of the engine: a binary
/// heap, every crossing an event, momenta (p, P) and masses as in the paper. It shares no code with the
/// engine. Real may be long double.
template <class Real>
class HeapSimulator {
 public:
  struct Event {
    Real time;
    std::size_t particle, scatterer;
    Real p_before, p_after, P_before, P_after;
  };

  /// Positions in [0, cells * cell_length), particle momenta p and scatterer momenta P; m = 1.
  HeapSimulator(Real sigma, Real cell_length, const std::vector<Real>& positions,
                const std::vector<Real>& momenta, const std::vector<Real>& scatterers)
      : sigma_(sigma), cell_length_(cell_length), P_(scatterers) {
    const auto cells = static_cast<long>(P_.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const Real p = momenta[i];
      // Searches the first scatterer ahead, from the particle's own cell.
      long cell = static_cast<long>(positions[i] / cell_length_);
      if (p > 0 && centre(cell) <= positions[i]) ++cell;
      if (p <= 0 && centre(cell) >= positions[i]) --cell;
      const Real distance = std::abs(centre(cell) - positions[i]);
      pending_.push({distance / std::abs(p), i, static_cast<std::size_t>((cell + cells) % cells), p});
    }
  }

  /// Sets the probability with which a particle scatters at every scatterer that it crosses.
  void scatter_with(double probability, std::uint64_t seed) {
    probability_ = probability;
    generator_.seed(seed);
  }

  /// After every collision reverses the momentum of the particle, of the scatterer, with these probabilities.
  void reverse(double of_particle, double of_scatterer, std::uint64_t seed) {
    particle_reversed_ = std::bernoulli_distribution(of_particle);
    scatterer_reversed_ = std::bernoulli_distribution(of_scatterer);
    coin_.seed(seed);
  }

  /// After every collision rotates the momenta of the particle, its scatterer and a neighbouring one, with
  /// this probability.
  void rotate_with(double probability, std::uint64_t seed) {
    rotated_ = std::bernoulli_distribution(probability);
    coin_.seed(seed);
  }

  Real scatterer_mass() const { return (1 + sigma_) / (1 - sigma_); }

  /// Energy of the scatterer and the particles of every cell, at a time between the last event and the next
  /// one.
  std::vector<Real> cell_energies(Real time) const {
    std::vector<Real> energies;
    for (const Real P : P_) energies.push_back(P * P / (2 * scatterer_mass()));
    const Real length = cell_length_ * static_cast<Real>(P_.size());
    for (auto pending = pending_; !pending.empty(); pending.pop()) {
      const Pending& next = pending.top();
      Real x = centre(static_cast<long>(next.scatterer)) - next.p * (next.time - time);
      x -= length * std::floor(x / length);
      energies[static_cast<std::size_t>(x / cell_length_) % P_.size()] += next.p * next.p / 2;
    }
    return energies;
  }

  /// Processes crossings up to the next collision before `until`; false if there is none.
  bool step(Real until, Event& event) {
    while (!pending_.empty() && pending_.top().time < until) {
      Pending next = pending_.top();
      pending_.pop();
      const bool scatters =
          probability_ >= 1 || std::uniform_real_distribution<>()(generator_) < probability_;
      if (scatters) {
        const Real p = next.p;
        Real& P = P_[next.scatterer];
        event = {next.time,
                 next.particle,
                 next.scatterer,
                 p,
                 -sigma_ * p + (1 - sigma_) * P,
                 P,
                 (1 + sigma_) * p + sigma_ * P};
        if (particle_reversed_(coin_)) event.p_after = -event.p_after;
        if (scatterer_reversed_(coin_)) event.P_after = -event.P_after;
        P = event.P_after;
        if (rotated_(coin_)) {
          const std::size_t step = std::bernoulli_distribution(0.5)(coin_) ? 1 : P_.size() - 1;
          rotate(event.p_after, P, P_[(next.scatterer + step) % P_.size()], scatterer_mass(), coin_);
          event.P_after = P;
        }
        next.p = event.p_after;
      }
      const std::size_t cells = P_.size();
      next.scatterer = (next.scatterer + (next.p > 0 ? 1 : cells - 1)) % cells;
      next.time += cell_length_ / std::abs(next.p);
      pending_.push(next);
      if (scatters) return true;
    }
    return false;
  }

 private:
  struct Pending {
    Real time;
    std::size_t particle, scatterer;
    Real p;
    bool operator<(const Pending& other) const {  // the heap's top is the largest
      return time > other.time || (time == other.time && particle > other.particle);
    }
  };

  Real centre(long cell) const { return (static_cast<Real>(cell) + Real(0.5)) * cell_length_; }

  Real sigma_, cell_length_;
  std::vector<Real> P_;
  std::priority_queue<Pending> pending_;
  double probability_ = 1;
  std::mt19937_64 generator_;
  std::bernoulli_distribution particle_reversed_{0}, scatterer_reversed_{0}, rotated_{0};
  std::mt19937_64 coin_;
};

/// Simulator in the initial state of the engine: any type with particles[i].{position,velocity} and
/// scatterers[i] in energy-normalised variables.
template <class Real, class PhasePoint>
HeapSimulator<Real> heap_simulator(double sigma, double cell_length, const PhasePoint& start) {
  std::vector<Real> positions, momenta, scatterers;
  for (const auto& particle : start.particles) {
    positions.push_back(particle.position);
    momenta.push_back(particle.velocity);
  }
  const Real root_mass = std::sqrt((1 + Real(sigma)) / (1 - Real(sigma)));
  for (const double scatterer : start.scatterers) scatterers.push_back(root_mass * scatterer);
  return {Real(sigma), Real(cell_length), positions, momenta, scatterers};
}

}  // namespace reference
