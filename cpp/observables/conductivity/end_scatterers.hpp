#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/path.hpp"
#include "model/open_chain.hpp"
#include "observables/conductivity/scattering_control.hpp"
#include "sampling/stationarity.hpp"
#include "statistics/tally.hpp"

namespace lorentz {

/// Tallies of the currents through the openings, means of both, and the temperatures of the end cells [eq.
/// 25, eq. 26], with the control variates of the latter.
struct EndTallies : StationaryTallies {
  Axis end{"end", "1", "0: first cell, 1: last", {0, 1}};
  ScalarTally energy_current = tally("energy_current", "energy/time", "J_U, positive to the right");
  ScalarTally particle_current = tally("particle_current", "1/time", "J_n, positive to the right");
  Tally temperature = tally("temperature", {end}, "temperature", "Time average of P^2/M");
  Tally scattering = tally("scattering", {end}, "energy", "Scattering martingale; mean 0");

  Columns measured() const { return columns_of({energy_current, particle_current, temperature}); }
  Columns controls() const { return columns_of({injection, scattering}); }
};

/// Observer of the end scatterers that fills EndTallies.
class EndScatterers {
 public:
  EndScatterers(const OpenChain& chain, const Window& window)
      : window_(window), ends_{EndCell(0, chain), EndCell(chain.cells - 1, chain)} {}

  [[gnu::always_inline]] void on_scatterer(std::uint32_t cell, double before, double time) {
    for (EndCell& end : ends_)
      if (cell == end.scatterer) end.chance.advance(before, time);
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

  void finish(const std::vector<double>& scatterers, double end_time) {
    for (EndCell& end : ends_) end.chance.advance(scatterers[end.scatterer], end_time);
  }

  void record(const EndTallies& tallies, const WindowHalves& halves, TallySums& sums) const {
    sums[tallies.energy_current] = halves.openings().energy / halves.duration();
    sums[tallies.particle_current] = halves.openings().particles / halves.duration();
    sums.set(tallies.temperature, halves.end_temperatures());
    for (std::size_t i = 0; i < ends_.size(); ++i) sums[tallies.scattering][i] = ends_[i].chance.sum();
  }

 private:
  struct EndCell {
    std::uint32_t scatterer;
    std::int64_t mark;
    ScatteringControl chance;

    EndCell(std::uint32_t cell, const OpenChain& chain)
        : scatterer(cell), mark(2 * std::int64_t{cell} + 1), chance(chain) {}
  };

  Window window_;
  std::array<EndCell, 2> ends_;
};

}  // namespace lorentz
