#pragma once

#include "observables/conductivity/ends_and_openings.hpp"
#include "statistics/tally.hpp"

namespace lorentz {

/// Tallies of the whole window: means over its blocks, or differences between its second half and its first
/// [eq. 51].
struct WindowTallies : TallySchema {
  Axis end{"end", "1", "0: first cell, 1: last", {0, 1}};
  ScalarTally energy_current = tally("energy_current", "energy/time", "J_U, mean of both openings");
  ScalarTally particle_current = tally("particle_current", "1/time", "J_n, mean of both openings");
  Tally temperature = tally("temperature", {end}, "temperature", "Time average of P^2/M");
  Tally arriving_energy =
      tally("arriving_energy", {end}, "energy", "Sum of u^2 over arrivals at the scatterer");
  Tally arrivals = tally("arrivals", {end}, "1", "Arrivals at the scatterer");
  Tally injection = tally("injection", {InjectionControls::axis()}, "1", "Injected, minus its mean");
  Tally scattering = tally("scattering", {end}, "energy", "Scattering martingale");

  Columns currents_and_temperatures() const {
    return columns_of({energy_current, particle_current, temperature});
  }
  Columns measured() const {
    return columns_of({energy_current, particle_current, temperature, arriving_energy, arrivals});
  }
  Columns controls() const { return columns_of({injection, scattering}); }
};

/// Means over the window of the tallies that have blocks.
Records window_means(const Records& records, const BlockTallies& blocks);

/// Means over the second half of the window minus those over the first. Arrivals are those of the whole
/// window.
Records half_differences(const Records& records, const BlockTallies& blocks);

}  // namespace lorentz
