#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/event_queue.hpp"
#include "engine/flights.hpp"
#include "engine/launch.hpp"
#include "engine/scattering.hpp"
#include "model/closed_chain.hpp"
#include "model/phase_point.hpp"

namespace lorentz {

/// Two trajectories of one chain, plain and perturbed, that share all random numbers, simulated together:
/// what is the same in both is done once.
///
/// A particle or scatterer is single until the trajectories differ in it. A single particle that meets a
/// double scatterer becomes double, and so does a single scatterer that is met by one copy of a double
/// particle. Copies of double particles are events of their own, with numbers of their own. The result is
/// that of two separate simulations, bit for bit (unless a single and a double particle meet one scatterer at
/// exactly the same time, where the order of the numbers decides).
class PairDynamics {
 public:
  /// share: false makes everything double from the start, that is, two simulations in full.
  PairDynamics(const ClosedChain& chain, const PhasePoint& plain, const PhasePoint& perturbed,
               double end_time, const StreamKey& key, bool share = true);

  /// Every collision before `until`. heartbeat(time) is called every 65536 events and may throw to stop.
  template <std::invocable<double> Heartbeat>
  void run(double until, Heartbeat&& heartbeat) {
    if (launch_.deterministic())
      advance<false>(until, heartbeat);
    else
      advance<true>(until, heartbeat);
  }

  /// visit(number, plain, perturbed) for every double particle, at a time between the last event and the
  /// next. The others are the same in both trajectories.
  template <std::invocable<std::uint32_t, const Particle&, const Particle&> Visit>
  void for_each_double_particle(double time, Visit&& visit) const {
    const auto seen = [&](const Flight& flight) {
      return Particle{position(flight, time, chain_), flight.velocity};
    };
    for (std::size_t place = 1; place < double_flights_.size(); ++place) {
      const auto& [plain, perturbed] = double_flights_[place];
      visit(plain.particle, seen(plain), seen(perturbed));
    }
  }

  /// visit(cell, plain U, perturbed U) for every double scatterer.
  template <std::invocable<std::uint32_t, double, double> Visit>
  void for_each_double_scatterer(Visit&& visit) const {
    const double scale = scatter_.rule().scatterer_scale();
    for (const std::uint32_t cell : double_cells_)
      visit(cell, scale * scatterers_[cell][0], scale * scatterers_[cell][1]);
  }

  /// Collisions in both trajectories, and how many of them had to be worked out.
  std::uint64_t events() const { return shared_ * 2 + separate_; }
  std::uint64_t computed() const { return shared_ + separate_; }

 private:
  static constexpr std::uint32_t single = 0;

  template <bool launching, class Heartbeat>
  void advance(double until, Heartbeat&& heartbeat) {
    constexpr std::uint64_t events_per_heartbeat = 65536;
    const Scattering scatter = scatter_;
    const auto collide = [&](Flight& flight, double& w) {
      scatter.template operator()<launching>(flight, w, launch_);
      queue_.schedule(flight);
    };
    const std::uint32_t particles = chain_.particles();
    for (Flight flight; queue_.take_before(until, flight);) {
      if (++taken_ % events_per_heartbeat == 0) heartbeat(until);
      const std::uint32_t cell = flight.target;
      const bool second = flight.particle >= particles;
      std::uint32_t place = places_[second ? flight.particle - particles : flight.particle];
      if ((place != single) != double_scatterers_[cell]) [[unlikely]] {
        if (place == single) {
          Flight twin = flight;
          twin.particle += particles;
          collide(twin, scatterers_[cell][1]);
          place = add_double_particle(flight, twin);
          ++separate_;
        } else {
          add_double_scatterer(cell);
        }
      }
      collide(flight, scatterers_[cell][second]);
      double_flights_[place][second] = flight;
      ++(place == single ? shared_ : separate_);
    }
  }

  std::uint32_t add_double_particle(const Flight& plain, const Flight& perturbed);
  void add_double_scatterer(std::uint32_t cell);
  std::vector<Flight> first_events(const PhasePoint& plain, const PhasePoint& perturbed, double end_time,
                                   bool share);

  ClosedChain chain_;
  Scattering scatter_;
  Launch launch_;
  std::vector<std::uint32_t> places_;  // of a particle in double_flights_, or single
  std::vector<std::array<Flight, 2>>
      double_flights_;                   // the present ones of both copies; the first is scratch
  std::vector<char> double_scatterers_;  // whether a scatterer is among double_cells_
  std::vector<std::uint32_t> double_cells_;
  std::vector<std::array<double, 2>> scatterers_;  // w of both trajectories; the second one if double
  EventQueue queue_;  // numbers of the plain trajectory, then those of the perturbed one
  std::uint64_t taken_ = 0, shared_ = 0, separate_ = 0;
};

}  // namespace lorentz
