#pragma once

#include <cstdint>
#include <string>

#include "model/reservoir.hpp"
#include "program/options.hpp"

namespace lorentz {

/// --cells, --sigma and --gamma of any chain; gamma is infinite for the word N.
void add_scattering_options(Options& options, std::uint32_t& cells, double& sigma, double& gamma,
                            Range<double> gamma_range);

/// --nu-left, --nu-right, --temperature-left and --temperature-right.
void add_reservoir_options(Options& options, Reservoir& left, Reservoir& right);

/// Throws UsageError, which names the options and what they lead to, unless low <= value <= high.
void require_within(double value, double low, double high, const std::string& options,
                    const std::string& what);

/// Throws UsageError unless fourth powers of momenta are numbers with full precision.
void require_fourth_powers(const Reservoir& left, const Reservoir& right);

/// Flights across a cell at thermal speed, one after the other, that a run may last. A clock that is never
/// restarted then still resolves 1e-6 of a flight; where it is restarted, the limit is one that no run
/// reaches within a year.
constexpr double flights_of_one_clock = 1e10, flights_of_a_year = 1e15;

/// What sets the size of the numbers in a simulation.
struct Extent {
  double hottest;  // temperature
  double cell_length;
  double end_time;
  double particles;                 // that take part
  double most_flights;              // of one clock, or of a year
  std::string temperatures, times;  // the options
};

/// Throws UsageError unless energies, their sums and all times are numbers with full precision.
void require_representable(const Extent& extent);

}  // namespace lorentz
