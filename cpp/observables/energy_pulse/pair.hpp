#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <stdexcept>
#include <variant>
#include <vector>

#include "engine/event_loop.hpp"
#include "engine/event_queue.hpp"
#include "engine/flights.hpp"
#include "engine/free_flight.hpp"
#include "engine/scattering.hpp"
#include "model/closed_chain.hpp"
#include "model/phase_point.hpp"
#include "model/rules.hpp"

namespace lorentz {

/// Two trajectories of one chain, plain and perturbed, with the same random numbers, simulated together: what
/// is the same in both is computed once.
///
/// A particle or scatterer is shared until the trajectories differ in it, and diverged from then on. A shared
/// particle that meets a diverged scatterer diverges, and so does a shared scatterer that is met by one copy
/// of a diverged particle. The copies of a diverged particle have events and numbers of their own. The result
/// is that of two separate simulations, bit for bit, unless a shared and a diverged particle meet one
/// scatterer at exactly the same time, where the order of the numbers decides.
class PairDynamics {
 public:
  /// share: false makes everything diverged from the start, that is, two complete simulations. run() throws
  /// std::logic_error for a NeighbourRule.
  PairDynamics(const ClosedChain& chain, const PhasePoint& plain, const PhasePoint& perturbed,
               double end_time, const StreamKey& key, bool share = true);

  /// Processes every collision before `until`.
  void run(double until, const Heartbeat& heartbeat) {
    const auto advance_with = [&](const auto& rule) {
      if (free_flight_.passing())
        advance<true>(rule, until, heartbeat);
      else
        advance<false>(rule, until, heartbeat);
    };
    std::visit(advance_with, rule_);
  }

  /// Calls visit(number, plain, perturbed) for every diverged particle, at a time between the last event and
  /// the next. The others are the same in both trajectories.
  template <std::invocable<std::uint32_t, const Particle&, const Particle&> Visit>
  void for_each_diverged_particle(double time, Visit&& visit) const {
    const auto seen = [&](const Flight& flight) {
      return Particle{position(flight, time, chain_), flight.velocity};
    };
    for (std::size_t index = 1; index < diverged_flights_.size(); ++index) {
      const auto& [plain, perturbed] = diverged_flights_[index];
      visit(plain.particle, seen(plain), seen(perturbed));
    }
  }

  /// Calls visit(cell, plain U, perturbed U) for every diverged scatterer.
  template <std::invocable<std::uint32_t, double, double> Visit>
  void for_each_diverged_scatterer(Visit&& visit) const {
    const double scale = masses(rule_).scatterer_scale();
    for (const std::uint32_t cell : diverged_cells_)
      visit(cell, scale * scatterers_[cell][0], scale * scatterers_[cell][1]);
  }

  /// Collisions in both trajectories.
  std::uint64_t events() const { return shared_events_ * 2 + separate_events_; }

 private:
  static constexpr std::uint32_t shared = 0;

  template <bool passing, CollisionRule Rule>
  void advance(const Rule& rule, double until, const Heartbeat& heartbeat) {
    if constexpr (NeighbourRule<Rule>) throw std::logic_error("pairs have no rule that changes a neighbour");
    const Scattering<Rule, passing> scatter(chain_, rule);
    const auto scatterers = [this](bool perturbed) {
      return [this, perturbed](std::uint32_t cell) -> double& { return scatterers_[cell][perturbed]; };
    };
    const std::uint32_t particles = chain_.particles();
    const auto arrive = [&](Flight flight, EventQueue::Cursor& cursor) {
      const std::uint32_t cell = flight.target;
      const bool perturbed = flight.particle >= particles;
      std::uint32_t index = indices_[perturbed ? flight.particle - particles : flight.particle];
      if ((index != shared) != scatterer_diverged_[cell]) [[unlikely]] {
        if (index == shared) {
          Flight copy = flight;
          copy.particle += particles;
          scatter(copy, scatterers(true), free_flight_);
          cursor.add(copy);
          index = diverge_particle(flight, copy);
          ++separate_events_;
        } else {
          diverge_scatterer(cell);
        }
      }
      scatter(flight, scatterers(perturbed), free_flight_);
      cursor.reschedule<true>(flight);
      diverged_flights_[index][perturbed] = flight;
      ++(index == shared ? shared_events_ : separate_events_);
    };
    EventQueue::Cursor cursor(queue_);
    process_arrivals(cursor, until, taken_, arrive, heartbeat);
  }

  std::uint32_t diverge_particle(const Flight& plain, const Flight& perturbed);
  void diverge_scatterer(std::uint32_t cell);
  std::vector<Flight> first_events(const PhasePoint& plain, const PhasePoint& perturbed, double end_time,
                                   bool share);

  ClosedChain chain_;
  Rules rule_;
  FreeFlight free_flight_;
  std::vector<std::uint32_t> indices_;                   // of particles in diverged_flights_, or shared
  std::vector<std::array<Flight, 2>> diverged_flights_;  // present ones, plain and perturbed; 0 is scratch
  std::vector<char> scatterer_diverged_;                 // whether a scatterer is among diverged_cells_
  std::vector<std::uint32_t> diverged_cells_;
  std::vector<std::array<double, 2>> scatterers_;  // w, plain and perturbed; of a shared one the first counts
  EventQueue queue_;  // particles by number, then the perturbed copies in the same order
  EventCounter taken_;
  std::uint64_t shared_events_ = 0, separate_events_ = 0;
};

}  // namespace lorentz
