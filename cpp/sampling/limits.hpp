#pragma once

#include <string>

#include "model/closed_chain.hpp"
#include "model/open_chain.hpp"
#include "model/reservoir.hpp"

namespace lorentz {

/// Throws UsageError unless low <= value <= high. `what` names the value, `options` the options that
/// determine it.
void require_within(double value, double low, double high, const std::string& options,
                    const std::string& what);

/// Throws UsageError if a replica has to keep more than 1e8 values (800 MB). `options` names the
/// options that determine their number.
void require_record_size(double values, const std::string& options);

/// Throws UsageError unless fourth powers of momenta are representable with full precision.
void require_fourth_powers(const Reservoir& left, const Reservoir& right);

/// Throws UsageError unless sums of the temperature to a power, over the crossings of up to 1e9 particles and
/// per unit time of the window, are finite.
void require_finite_currents(const OpenChain& chain, double duration, int power);

/// Largest numbers of successive flights across a cell at thermal speed in a run. With 1e10, a clock that
/// never restarts still resolves 1e-6 of a flight; with a clock that restarts, no run reaches 1e15 within a
/// year.
constexpr double flights_of_one_clock = 1e10, flights_of_a_year = 1e15;

/// Quantities that determine the magnitude of the numbers in a simulation.
struct Extent {
  double hottest;  // temperature
  double cell_length;
  double end_time;
  double particles;                 // number of all particles, and scatterers of a closed chain
  double most_flights;              // flights_of_one_clock or flights_of_a_year
  std::string temperatures, times;  // names of the options
};

/// Throws UsageError unless energies, their sums and all times are representable with full precision.
void require_representable(const Extent& extent);

/// The same for a closed chain that runs until end_time. Also throws UsageError for more than 1e9 particles.
void require_possible(const ClosedChain& chain, double hottest, double end_time, double most_flights,
                      const std::string& temperatures, const std::string& times);

}  // namespace lorentz
