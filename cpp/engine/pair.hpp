#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/event_queue.hpp"
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

  /// The plain one and the perturbed one, at a time between the last event and the next.
  std::array<PhasePoint, 2> phase_points(double time) const;

  /// Collisions in both trajectories, and how many of them had to be worked out.
  std::uint64_t events() const { return shared_ * 2 + separate_; }
  std::uint64_t computed() const { return shared_ + separate_; }

 private:
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
      if (!double_particles_[second ? flight.particle - particles : flight.particle]) {
        if (double_scatterers_[cell]) {
          double_particles_[flight.particle] = true;
          Flight twin = flight;
          twin.particle += particles;
          collide(flight, scatterers_[0][cell]);
          collide(twin, scatterers_[1][cell]);
          separate_ += 2;
        } else {
          collide(flight, scatterers_[0][cell]);
          ++shared_;
        }
      } else {
        if (!std::exchange(double_scatterers_[cell], true)) scatterers_[1][cell] = scatterers_[0][cell];
        collide(flight, scatterers_[second ? 1 : 0][cell]);
        ++separate_;
      }
    }
  }

  ClosedChain chain_;
  Scattering scatter_;
  Launch launch_;
  std::vector<char> double_particles_, double_scatterers_;
  std::vector<double> scatterers_[2];  // w of the plain and of the perturbed trajectory; the second if double
  EventQueue queue_;                   // numbers of the plain trajectory, then those of the perturbed one
  std::uint64_t taken_ = 0, shared_ = 0, separate_ = 0;
};

}  // namespace lorentz
