#include "observables/physics_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "program/errors.hpp"

namespace lorentz {

void add_scattering_options(Options& options, std::uint32_t& cells, double& sigma, double& gamma,
                            Range<double> gamma_range) {
  options.integer("--cells", cells, {1, 100'000'000}, "Number of cells N");
  options.real("--sigma", sigma, {-1, 1}, "Mass ratio (M-m)/(M+m)");
  options.real_or_word("--gamma", gamma, gamma_range, "N", std::numeric_limits<double>::infinity(),
                       "Mean number of scatterings in N cells; N: every scatterer scatters");
}

void add_reservoir_options(Options& options, Reservoir& left, Reservoir& right) {
  options.real("--nu-left", left.rate, non_negative, "Particles injected at the left per unit time");
  options.real("--nu-right", right.rate, non_negative, "Particles injected at the right per unit time");
  options.real("--temperature-left", left.temperature, positive, "Temperature of the left reservoir");
  options.real("--temperature-right", right.temperature, positive, "Temperature of the right reservoir");
}

void require_within(double value, double low, double high, const std::string& options,
                    const std::string& what) {
  if (value >= low && value <= high) return;
  throw UsageError(fmt::format(
      "{}: {} would be {:.3g}, which is not in [{:g}, {:g}]: outside, numbers lose their precision or "
      "no run ends. Choose others, or other units.",
      options, what, value, low, high));
}

void require_fourth_powers(const Reservoir& left, const Reservoir& right) {
  for (const Reservoir& each : {left, right})
    require_within(each.temperature, 1e-140, 1e140, "--temperature-left, --temperature-right",
                   "a temperature");
}

void require_representable(const Extent& extent) {
  const double flight = extent.cell_length / std::sqrt(extent.hottest);
  const double flights = extent.end_time / flight;
  require_within(extent.hottest, 1e-300, 1e300, extent.temperatures, "the highest temperature");
  require_within(flight, 1e-290, 1e290, "--cell-length, " + extent.temperatures,
                 "the time of a thermal flight");
  require_within(extent.end_time, 1e-290, 1e290, extent.times, "the end of the run");
  require_within(flights, 0, extent.most_flights, extent.times,
                 "the number of thermal flights of one particle");
  require_within(extent.hottest * std::max(1.0, flights) * std::max(1.0, extent.particles), 0, 1e304,
                 extent.temperatures, "the sum of all energies seen");
}

}  // namespace lorentz
