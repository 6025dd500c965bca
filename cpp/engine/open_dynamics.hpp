#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <variant>
#include <vector>

#include "engine/event_loop.hpp"
#include "engine/event_queue.hpp"
#include "engine/free_flight.hpp"
#include "engine/id_pool.hpp"
#include "engine/injector.hpp"
#include "engine/observation.hpp"
#include "engine/path.hpp"
#include "model/open_chain.hpp"
#include "model/phase_point.hpp"
#include "model/rules.hpp"
#include "numerics/random.hpp"

namespace lorentz {

enum class End : std::uint8_t { left, right };

/// The dynamics of an open chain. m = 1, so the energy-normalised u is the momentum p.
class OpenDynamics {
 public:
  /// Arrivals at or after end_time (> 0) are frozen; simulate() goes no further. Throws
  /// std::invalid_argument if the start does not have one scatterer per cell.
  OpenDynamics(const OpenChain& chain, const PhasePoint& start, double end_time, const StreamKey& key);

  std::uint64_t events() const { return events_.events(); }  // collisions and injections

  /// U of every scatterer.
  std::vector<double> scatterers() const;

 private:
  template <class Observer>
  friend void simulate(OpenDynamics&, double, Observer&, const Heartbeat&);
  template <bool passing, CollisionRule Rule, class Observer>
  void advance(const Rule& rule, double until, Observer& observer, const Heartbeat& heartbeat);
  template <bool passing, class Observer>
  void inject(End end, Observer& observer, EventQueue::Cursor& cursor);
  /// Inlined and by value, so that the flight stays in registers: by reference an event takes 1.4 times as
  /// long (docs/numerics.md).
  template <bool passing, class Observer, std::invocable<const Flight&> Schedule>
  [[gnu::always_inline]] void fly(Flight flight, double from, std::int64_t first, std::int64_t next_cell,
                                  Observer& observer, const Schedule& schedule);
  template <bool passing, class Observer>
  void announce_start(Observer& observer, EventQueue::Cursor& cursor);

  OpenChain chain_;
  Rules rule_;
  GeometricCells cells_to_scattering_;
  double half_cell_;
  StreamKey key_;
  RandomStream passes_;
  std::array<Injector, 2> injectors_;  // by End
  std::vector<double> scatterers_;     // w, see ScattererMass
  std::vector<std::uint64_t> drawn_;   // collisions with random numbers so far, by cell
  std::vector<Particle> newcomers_;    // of the start, until the first call of simulate()
  IdPool ids_;
  EventQueue queue_;
  EventCounter events_;
};

/// Advances the chain through all events before `until`, in the order of time. Hooks of the observer, all
/// optional (engine/observation.hpp):
///   on_collision(const Collision&)
///   on_scatterer(cell, double before, double time)  U of a scatterer changes, by a collision or by another's
///   on_flight(const Path&)                    at every departure
///   on_injection(End, double time, double u)  u of the particle that enters, energy-normalised
///   on_exit(End, double time, double u)       called when the last flight begins; `time` may exceed `until`
/// The flights of the particles present at time 0 are reported in the first call of simulate() for a chain.
template <class Observer>
void simulate(OpenDynamics& chain, double until, Observer& observer, const Heartbeat& heartbeat) {
  const auto advance = [&](const auto& rule) {
    if (chain.chain_.deterministic())
      chain.advance<false>(rule, until, observer, heartbeat);
    else
      chain.advance<true>(rule, until, observer, heartbeat);
  };
  std::visit(advance, chain.rule_);
}

/// passing: whether a particle may pass a scatterer. The random numbers of a rule are named by the cell and
/// the count of its collisions, because numbers of particles are reused.
template <bool passing, CollisionRule Rule, class Observer>
void OpenDynamics::advance(const Rule& rule, double until, Observer& observer, const Heartbeat& heartbeat) {
  const Rule collide = rule;  // a copy: for the compiler a reference may alias
  const double scale = collide.scatterer_scale(), half_cell = half_cell_;
  const std::uint32_t cells = chain_.cells;
  double* const scatterers = scatterers_.data();
  const auto arrive = [&](Flight flight, EventQueue::Cursor& cursor) __attribute__((always_inline)) {
    const std::uint32_t cell = flight.target;
    const double time = flight.time, particle = flight.velocity, scatterer = scatterers[cell];
    if constexpr (DrawingRule<Rule>) {
      RandomStream random(key_, Purpose::collision, cell, drawn_[cell]++);
      if constexpr (NeighbourRule<Rule>) {
        const bool right = random.uniform() < 0.5;
        const std::uint32_t other = cell == 0 ? 1 : cell + 1 == cells || !right ? cell - 1 : cell + 1;
        const double before = scatterers[other];
        collide(flight.velocity, scatterers[cell], scatterers[other], cell, random);
        notify_scatterer(observer, other, scale * before, time);
      } else {
        collide(flight.velocity, scatterers[cell], cell, random);
      }
    } else {
      collide(flight.velocity, scatterers[cell], cell);
    }
    notify(observer, Collision{time, flight.particle, cell, particle, flight.velocity, scale * scatterer,
                               scale * scatterers[cell]});
    notify_scatterer(observer, cell, scale * scatterer, time);
    const std::int64_t step = direction(flight.velocity), position = 2 * std::int64_t{cell} + 1;
    if constexpr (!passing) {
      if (const std::uint32_t target = cell + static_cast<std::uint32_t>(step); target < cells) [[likely]] {
        // The same as fly(), for the most frequent flight: over a whole cell.
        const double time_per_half_cell = half_cell / std::abs(flight.velocity);
        const double arrival = time + 2 * time_per_half_cell;
        notify_flight(observer, Path{time, arrival, flight.velocity, static_cast<double>(position),
                                     position + step, position + 2 * step, time_per_half_cell});
        flight.target = target;
        flight.time = arrival;
        cursor.reschedule<false>(flight);
        return;
      }
    }
    fly<passing>(flight, static_cast<double>(position), position + step, cell + step, observer,
                 [&](const Flight& next) __attribute__((always_inline)) { cursor.reschedule<false>(next); });
  };
  EventQueue::Cursor cursor(queue_);
  announce_start<passing>(observer, cursor);
  for (;;) {
    const End next = injectors_[0].time() <= injectors_[1].time() ? End::left : End::right;
    const double injection = injectors_[static_cast<std::size_t>(next)].time();
    process_arrivals(cursor, std::min(until, injection), events_, arrive, heartbeat);
    if (!(injection < until)) return;
    inject<passing>(next, observer, cursor);
    events_.add(1, injection, heartbeat);
  }
}

template <bool passing, class Observer>
void OpenDynamics::inject(End end, Observer& observer, EventQueue::Cursor& cursor) {
  Injector& injector = injectors_[static_cast<std::size_t>(end)];
  const double time = injector.time(), speed = injector.take();
  const double u = end == End::left ? speed : -speed;
  if constexpr (requires { observer.on_injection(end, time, u); }) observer.on_injection(end, time, u);
  const std::int64_t opening = end == End::left ? 0 : chain_.right_opening();
  const std::int64_t cell = end == End::left ? 0 : std::int64_t{chain_.cells} - 1;
  fly<passing>({time, u, 0, ids_.take()}, static_cast<double>(opening), opening, cell, observer,
               [&](const Flight& flight) { cursor.add(flight); });
}

/// Begins a flight at flight.time and at the position `from`, with the mark `first` ahead and the scatterer
/// of next_cell as the next one.
template <bool passing, class Observer, std::invocable<const Flight&> Schedule>
inline void OpenDynamics::fly(Flight flight, double from, std::int64_t first, std::int64_t next_cell,
                              Observer& observer, const Schedule& schedule) {
  const double u = flight.velocity, departure = flight.time;
  const std::int64_t cells = passing ? cells_to_scattering_(passes_.uniform()) : 1;
  const std::int64_t target = next_cell + direction(u) * (cells - 1);
  const bool leaves = static_cast<std::uint64_t>(target) >= chain_.cells;  // negative ones too
  const std::int64_t last = std::clamp<std::int64_t>(2 * target + 1, 0, chain_.right_opening());
  const double time_per_half_cell = half_cell_ / std::abs(u);
  const double arrival = departure + std::abs(static_cast<double>(last) - from) * time_per_half_cell;
  notify_flight(observer, Path{departure, arrival, u, from, first, last, time_per_half_cell});
  if (leaves) [[unlikely]] {
    if constexpr (requires { observer.on_exit(End::left, arrival, u); })
      observer.on_exit(last > 0 ? End::right : End::left, arrival, u);
    ids_.give_back(flight.particle);
    return;
  }
  flight.target = static_cast<std::uint32_t>(target);
  flight.time = arrival;
  schedule(flight);
}

template <bool passing, class Observer>
void OpenDynamics::announce_start(Observer& observer, EventQueue::Cursor& cursor) {
  for (const Particle& particle : newcomers_) {
    const double from = particle.position / half_cell_;
    const bool rightwards = direction(particle.velocity) > 0;
    const auto first = static_cast<std::int64_t>(rightwards ? std::floor(from) + 1 : std::ceil(from) - 1);
    // Scatterers are at odd positions.
    const std::int64_t cell = rightwards ? first / 2 : (first + 1) / 2 - 1;
    fly<passing>({0, particle.velocity, 0, ids_.take()}, from, first, cell, observer,
                 [&](const Flight& flight) { cursor.add(flight); });
  }
  newcomers_.clear();
}

}  // namespace lorentz
