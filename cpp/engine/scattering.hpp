#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/flight.hpp"
#include "engine/free_flight.hpp"
#include "model/closed_chain.hpp"
#include "model/collision_rule.hpp"

namespace lorentz {

/// Start of a flight in a closed chain, which follows every collision.
struct Departure {
  double time;             // of the departure, on the clock of Collision::time
  std::uint32_t particle;  // number, from 0
  double velocity;         // u, energy-normalised; with m = 1 the momentum
  std::int64_t cells;      // number of cells to the next scattering, with the sign of the velocity
  double duration;         // time to the next scattering; infinite for a particle at rest
  int neighbour;  // 1: the collision changed the scatterer to the right, too; -1: to the left; 0: none
};

/// A collision and the flight that follows it, on a ring of cells. passing: whether a particle may pass a
/// scatterer; otherwise it scatters again at the neighbouring one.
template <CollisionRule Rule, bool passing>
class Scattering {
 public:
  Scattering(const ClosedChain& chain, const Rule& rule)
      : cells_(chain.cells), cell_length_(chain.cell_length), collide_(rule) {
    for (std::uint32_t cell = 0; cell < cells_; ++cell)
      neighbours_.push_back({cell + 1 < cells_ ? cell + 1 : 0, cell > 0 ? cell - 1 : cells_ - 1});
  }

  /// Ends the flight at its scatterer and begins the next one, in place. w(cell) is the scaled velocity of a
  /// scatterer.
  template <class Scatterer>
  [[gnu::always_inline]] Departure operator()(Flight& flight, const Scatterer& w,
                                              const FreeFlight& free_flight) const {
    // Copies: for the compiler the references may alias.
    double u = flight.velocity, scatterer = w(flight.target);
    [[maybe_unused]] const std::uint64_t draw = flight.draws;
    if constexpr (DrawingRule<Rule> || passing) ++flight.draws;
    int side = 0;
    if constexpr (DrawingRule<Rule>) {
      RandomStream random = free_flight.of_collision(flight.particle, draw);
      if constexpr (NeighbourRule<Rule>) {
        const bool left = random.uniform() < 0.5;
        side = left ? -1 : 1;
        collide_(u, scatterer, w(neighbours_[flight.target][left]), flight.target, random);
      } else {
        collide_(u, scatterer, flight.target, random);
      }
    } else {
      collide_(u, scatterer, flight.target);
    }
    w(flight.target) = scatterer;
    std::int64_t cells = 1;
    if constexpr (passing) cells = free_flight.cells(flight.particle, draw);
    flight.velocity = u;
    const double duration = static_cast<double>(cells) * cell_length_ / std::abs(u);
    const Departure departure{flight.time, flight.particle, u, direction(u) * cells, duration, side};
    flight.target = passing ? cells_ahead(flight.target, departure.cells) : neighbour(flight.target, u);
    flight.time += duration;
    return departure;
  }

 private:
  std::uint32_t neighbour(std::uint32_t cell, double velocity) const {
    return neighbours_[cell][std::bit_cast<std::uint64_t>(velocity) >> 63];
  }

  std::uint32_t cells_ahead(std::uint32_t cell, std::int64_t cells) const {
    const auto around = static_cast<std::int64_t>(cells_);
    const std::int64_t target = (cell + cells) % around;
    return static_cast<std::uint32_t>(target < 0 ? target + around : target);
  }

  std::uint32_t cells_;
  double cell_length_;
  Rule collide_;
  std::vector<std::array<std::uint32_t, 2>> neighbours_;  // to the right, to the left
};

}  // namespace lorentz
