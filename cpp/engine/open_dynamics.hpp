#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <vector>

#include "engine/closed_dynamics.hpp"
#include "engine/event_queue.hpp"
#include "engine/injector.hpp"
#include "engine/launch.hpp"
#include "engine/numbers.hpp"
#include "engine/observation.hpp"
#include "engine/path.hpp"
#include "engine/random.hpp"
#include "model/collision.hpp"
#include "model/open_chain.hpp"
#include "model/phase_point.hpp"

namespace lorentz {

enum class End : std::uint8_t { left, right };

/// An open chain in motion. Its particles' momenta are energy-normalised, and m = 1, so u = p.
class OpenDynamics {
 public:
  /// Arrivals at or after end_time (> 0) are frozen; simulate() can go no further. Throws
  /// std::invalid_argument if the start does not have one scatterer per cell.
  OpenDynamics(const OpenChain& chain, const PhasePoint& start, double end_time, const StreamKey& key);

  std::uint64_t events() const { return events_; }  // collisions and injections

  /// U of every scatterer.
  std::vector<double> scatterers() const;

  /// Energy of the scatterers and of the particles that have another collision before them; those on their
  /// way out are gone.
  double energy() const;

 private:
  template <class Observer, std::invocable<double> Heartbeat>
  friend void simulate(OpenDynamics&, double, Observer&, Heartbeat&&);
  template <bool passing, class Observer, std::invocable<double> Heartbeat>
  void advance(double until, Observer& observer, Heartbeat&& heartbeat);
  template <bool passing, class Observer>
  void enter(End end, Observer& observer);
  /// Inlined and by value, so that the flight stays in registers: by reference an event takes 1.4 times as
  /// long.
  template <bool passing, class Observer>
  [[gnu::always_inline]] void fly(Flight flight, double from, std::int64_t first, std::int64_t next_cell,
                                  Observer& observer);
  template <bool passing, class Observer>
  void announce_start(Observer& observer);

  /// Marks from the first one on to the next scattering, or beyond the chain.
  template <bool passing>
  std::int64_t cells_passed() {
    if constexpr (passing) return cells_to_scattering(passes_.uniform(), log_pass_probability_) - 1;
    return 0;
  }

  OpenChain chain_;
  CollisionRule collide_;
  double log_pass_probability_;
  double half_cell_;
  RandomStream passes_;
  std::array<Injector, 2> injectors_;  // by End
  std::vector<double> scatterers_;     // w, see CollisionRule
  std::vector<Particle> newcomers_;    // of the start, until the first call of simulate()
  Numbers numbers_;
  EventQueue queue_;
  std::uint64_t events_ = 0;
};

/// Advances the chain through everything before `until`, in the order of time. The observer may define
///   on_collision(const Collision&)
///   on_flight(const Path&)               at every departure; those of the start at time 0
///   on_injection(End, double time, double u)
///   on_exit(End, double time, double u)  announced when the last flight begins, so `time` may exceed `until`
/// and what it does not define costs nothing. The first call tells of the start's flights too, so an observer
/// that has to know every particle watches from the beginning. heartbeat(time) is called every 65536
/// events and may throw to stop.
template <class Observer, std::invocable<double> Heartbeat>
void simulate(OpenDynamics& chain, double until, Observer& observer, Heartbeat&& heartbeat) {
  if (chain.chain_.deterministic())
    chain.advance<false>(until, observer, heartbeat);
  else
    chain.advance<true>(until, observer, heartbeat);
}

template <bool passing, class Observer, std::invocable<double> Heartbeat>
void OpenDynamics::advance(double until, Observer& observer, Heartbeat&& heartbeat) {
  constexpr std::uint64_t events_per_heartbeat = 65536;
  const double scale = collide_.scatterer_scale();
  const auto count = [&](double now) {
    if (++events_ % events_per_heartbeat == 0) heartbeat(now);
  };
  announce_start<passing>(observer);
  for (;;) {
    const End next = injectors_[0].time() <= injectors_[1].time() ? End::left : End::right;
    const double entry = injectors_[static_cast<std::size_t>(next)].time();
    for (Flight flight; queue_.take_before(std::min(until, entry), flight);) {
      const std::uint32_t cell = flight.target;
      const double now = flight.time, particle = flight.velocity, scatterer = scatterers_[cell];
      collide_(flight.velocity, scatterers_[cell]);
      if constexpr (requires(const Collision& collision) { observer.on_collision(collision); }) {
        observer.on_collision(Collision{now, flight.particle, cell, particle, flight.velocity,
                                        scale * scatterer, scale * scatterers_[cell]});
      }
      const std::int64_t step = direction(flight.velocity);
      const std::int64_t place = 2 * std::int64_t{cell} + 1;
      fly<passing>(flight, static_cast<double>(place), place + step, cell + step, observer);
      count(now);
    }
    if (!(entry < until)) return;
    enter<passing>(next, observer);
    count(entry);
  }
}

template <bool passing, class Observer>
void OpenDynamics::enter(End end, Observer& observer) {
  Injector& injector = injectors_[static_cast<std::size_t>(end)];
  const double time = injector.time(), speed = injector.take();
  const double u = end == End::left ? speed : -speed;
  if constexpr (requires { observer.on_injection(end, time, u); }) observer.on_injection(end, time, u);
  const std::int64_t opening = end == End::left ? 0 : chain_.right_opening();
  const std::int64_t cell = end == End::left ? 0 : std::int64_t{chain_.cells} - 1;
  fly<passing>({time, u, 0, numbers_.take()}, static_cast<double>(opening), opening, cell, observer);
}

/// The flight that begins at the given one's time, from a place on, of a particle whose next scatterer is
/// that of next_cell.
template <bool passing, class Observer>
inline void OpenDynamics::fly(Flight flight, double from, std::int64_t first, std::int64_t next_cell,
                              Observer& observer) {
  const double u = flight.velocity, departure = flight.time;
  const std::int64_t passed = cells_passed<passing>();
  const std::int64_t target = next_cell + direction(u) * passed;
  const bool leaves = static_cast<std::uint64_t>(target) >= chain_.cells;  // negative ones too
  const std::int64_t last = std::clamp<std::int64_t>(2 * target + 1, 0, chain_.right_opening());
  const double time_per_place = half_cell_ / std::abs(u);
  const double arrival = departure + std::abs(static_cast<double>(last) - from) * time_per_place;
  if constexpr (requires(const Path& path) { observer.on_flight(path); })
    observer.on_flight(Path{departure, arrival, u, from, first, last, time_per_place});
  if (leaves) [[unlikely]] {
    if constexpr (requires { observer.on_exit(End::left, arrival, u); })
      observer.on_exit(last > 0 ? End::right : End::left, arrival, u);
    numbers_.give_back(flight.particle);
    return;
  }
  flight.target = static_cast<std::uint32_t>(target);
  flight.time = arrival;
  queue_.schedule(flight);
}

template <bool passing, class Observer>
void OpenDynamics::announce_start(Observer& observer) {
  for (const Particle& particle : newcomers_) {
    const double from = particle.position / half_cell_;
    const bool rightwards = direction(particle.velocity) > 0;
    const auto first = static_cast<std::int64_t>(rightwards ? std::floor(from) + 1 : std::ceil(from) - 1);
    // Scatterers stand at odd places.
    const std::int64_t cell = rightwards ? first / 2 : (first + 1) / 2 - 1;
    fly<passing>({0, particle.velocity, 0, numbers_.take()}, from, first, cell, observer);
  }
  newcomers_.clear();
}

}  // namespace lorentz
