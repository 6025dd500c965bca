#pragma once

#include <array>
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

/// Tallies of the currents through the openings, means of both, and the temperatures of the end cells [eq.
/// 26, eq. 27], with their control variates.
struct EndTallies : TallySchema {
  Axis end{"end", "1", "0: first cell, 1: last", {0, 1}};
  ScalarTally energy_current = tally("energy_current", "energy/time", "J_U, positive to the right");
  ScalarTally particle_current = tally("particle_current", "1/time", "J_n, positive to the right");
  Tally temperature = tally("temperature", {end}, "temperature", "Time average of P^2/M");
  Tally injection = tally("injection", {InjectionControls::axis()}, "1", "Injected, minus its known mean");
  Tally scattering = tally("scattering", {end}, "energy", "Scattering martingale; mean 0");

  Columns measured() const { return columns_of({energy_current, particle_current, temperature}); }
  Columns controls() const { return columns_of({injection, scattering}); }
};

/// Observer that fills EndTallies.
class EndsAndOpenings {
 public:
  EndsAndOpenings(const OpenChain& chain, const Window& window)
      : chain_(chain),
        window_(window),
        ends_{EndCell(0, chain, window), EndCell(chain.cells - 1, chain, window)} {}

  [[gnu::always_inline]] void on_scatterer(std::uint32_t cell, double before, double time) {
    for (EndCell& end : ends_)
      if (cell == end.scatterer) end.advance(before, time);
  }

  [[gnu::always_inline]] void on_flight(const Path& path) {  // called once per event
    const Marks marks = path.marks();
    if (marks.low > ends_[0].mark && marks.high < ends_[1].mark) [[likely]]
      return;
    for (EndCell& end : ends_) {
      if (!path.reaches(end.mark)) continue;
      const double time = path.time_at(end.mark);
      if (!window_.contains(time)) continue;
      end.chance.arrival(time, path.velocity, path.last == end.mark);
    }
  }

  void on_injection(End end, double, double u) {
    injections_.add(end, u);
    openings_.cross(u);
  }

  void on_exit(End, double time, double u) {
    if (window_.contains(time)) openings_.cross(u);
  }

  void finish(const std::vector<double>& scatterers, double end_time) {
    for (EndCell& end : ends_) end.advance(scatterers[end.scatterer], end_time);
  }

  void record(const EndTallies& tallies, TallySums& sums) const {
    const double duration = window_.end - window_.begin;
    sums[tallies.energy_current] = openings_.energy / duration;
    sums[tallies.particle_current] = openings_.particles / duration;
    sums.set(tallies.injection, injections_.deviations(chain_, duration));
    for (std::size_t i = 0; i < ends_.size(); ++i) {
      const EndCell& end = ends_[i];
      sums[tallies.temperature][i] = end.scatterer_energy.sums().front() / duration;
      sums[tallies.scattering][i] = end.chance.sum();
    }
  }

 private:
  struct EndCell {
    std::uint32_t scatterer;
    std::int64_t mark;
    TimeIntegral scatterer_energy;  // of U^2
    ScatteringControl chance;

    EndCell(std::uint32_t cell, const OpenChain& chain, const Window& window)
        : scatterer(cell),
          mark(2 * std::int64_t{cell} + 1),
          scatterer_energy(Blocks(window.begin, window.end, 1)),
          chance(chain) {}

    /// Adds the time since the last call up to `until`, during which the scatterer had this U.
    void advance(double momentum, double until) {
      scatterer_energy.advance(momentum * momentum, until);
      chance.advance(momentum, until);
    }
  };

  OpenChain chain_;
  Window window_;
  std::array<EndCell, 2> ends_;
  OpeningCurrents openings_;
  InjectionControls injections_;
};

}  // namespace lorentz
