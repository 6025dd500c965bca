#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/observation.hpp"
#include "engine/open_dynamics.hpp"
#include "engine/path.hpp"
#include "observables/conductivity/scattering_control.hpp"
#include "sampling/injection_controls.hpp"
#include "statistics/tally.hpp"
#include "statistics/time_integral.hpp"

namespace lorentz {

constexpr std::size_t block_count = 8;  // blocks of the window

/// Tallies of the currents through the openings and the temperatures of the end cells [eq. 26, eq. 27], by
/// blocks of the window, with their control variates; with one block those of the whole window.
struct BlockTallies : TallySchema {
  Axis block;
  Axis end{"end", "1", "0: first cell, 1: last", {0, 1}};
  Tally energy_current = tally("energy_current", {block}, "energy/time", "J_U, mean of both openings");
  Tally particle_current = tally("particle_current", {block}, "1/time", "J_n, mean of both openings");
  Tally temperature = tally("temperature", {block, end}, "temperature", "Time average of P^2/M");
  Tally arriving_energy =
      tally("arriving_energy", {end}, "energy", "Sum of u^2 over arrivals at the scatterer");
  Tally arrivals = tally("arrivals", {end}, "1", "Arrivals at the scatterer");
  Tally injection =
      tally("injection", {block, InjectionControls::axis()}, "1", "Injected, minus its known mean");
  Tally scattering = tally("scattering", {block, end}, "energy", "Scattering martingale; mean 0");

  explicit BlockTallies(std::size_t blocks = block_count)
      : block(numbered_axis("block", "Block of the window", blocks)) {}

  Columns currents_and_temperatures() const {
    return columns_of({energy_current, particle_current, temperature});
  }
  Columns measured() const {
    return columns_of({energy_current, particle_current, temperature, arriving_energy, arrivals});
  }
  Columns controls() const { return columns_of({injection, scattering}); }
};

/// Observer that fills BlockTallies.
class EndsAndOpenings {
 public:
  EndsAndOpenings(const OpenChain& chain, const Window& window)
      : chain_(chain),
        blocks_(window.begin, window.end, block_count),
        ends_{EndCell(0, chain, blocks_), EndCell(chain.cells - 1, chain, blocks_)} {}

  [[gnu::always_inline]] void on_collision(const Collision& collision) {
    for (EndCell& end : ends_)
      if (collision.scatterer == end.scatterer) end.advance(collision.scatterer_before, collision.time);
  }

  [[gnu::always_inline]] void on_flight(const Path& path) {  // called once per event
    const Marks marks = path.marks();
    if (marks.low > ends_[0].mark && marks.high < ends_[1].mark) [[likely]]
      return;
    for (EndCell& end : ends_) {
      if (!path.reaches(end.mark)) continue;
      const double time = path.time_at(end.mark);
      if (!blocks_.contain(time)) continue;
      end.chance.arrival(time, path.velocity, path.last == end.mark);
      end.arrivals += 1;
      end.arriving_energy += path.velocity * path.velocity;
    }
  }

  void on_injection(End end, double time, double u) {
    if (!blocks_.contain(time)) return;
    injections_[blocks_[time]].add(end, u);
    cross_opening(time, u);
  }

  void on_exit(End, double time, double u) {
    if (blocks_.contain(time)) cross_opening(time, u);
  }

  void finish(const std::vector<double>& scatterers, double end_time) {
    for (EndCell& end : ends_) end.advance(scatterers[end.scatterer], end_time);
  }

  void record(const BlockTallies& tallies, TallySums& sums) const {
    for (std::size_t block = 0; block < block_count; ++block) {
      sums[tallies.energy_current][block] = energy_[block] / blocks_.length();
      sums[tallies.particle_current][block] = particles_[block] / blocks_.length();
      const auto injected = injections_[block].deviations(chain_, blocks_.length());
      sums.set(tallies.injection.row(block), injected);
    }
    for (std::size_t i = 0; i < ends_.size(); ++i) {
      const EndCell& end = ends_[i];
      sums[tallies.arriving_energy][i] = end.arriving_energy;
      sums[tallies.arrivals][i] = end.arrivals;
      for (std::size_t block = 0; block < block_count; ++block) {
        sums[tallies.temperature.row(block)][i] = end.scatterer_energy.sums()[block] / blocks_.length();
        sums[tallies.scattering.row(block)][i] = end.chance.sums()[block];
      }
    }
  }

 private:
  struct EndCell {
    std::uint32_t scatterer;
    std::int64_t mark;
    TimeIntegral scatterer_energy;  // of U^2
    ScatteringControl chance;
    double arrivals = 0, arriving_energy = 0;  // sum of u^2

    EndCell(std::uint32_t cell, const OpenChain& chain, const Blocks& blocks)
        : scatterer(cell),
          mark(2 * std::int64_t{cell} + 1),
          scatterer_energy(blocks),
          chance(chain, blocks) {}

    /// Adds the time since the last call up to `until`, during which the scatterer had this U.
    void advance(double momentum, double until) {
      scatterer_energy.advance(momentum * momentum, until);
      chance.advance(momentum, until);
    }
  };

  /// Adds a crossing with the weight 1/2, because the current is the mean over both openings.
  void cross_opening(double time, double u) {
    const std::size_t block = blocks_[time];
    energy_[block] += 0.25 * u * std::abs(u);
    particles_[block] += std::copysign(0.5, u);
  }

  OpenChain chain_;
  Blocks blocks_;
  std::array<EndCell, 2> ends_;
  std::array<double, block_count> energy_{}, particles_{};
  std::array<InjectionControls, block_count> injections_;
};

}  // namespace lorentz
