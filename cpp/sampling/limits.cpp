#include "sampling/limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "program/errors.hpp"

namespace lorentz {

void require_within(double value, double low, double high, const std::string& options,
                    const std::string& what) {
  if (value >= low && value <= high) return;
  throw UsageError(fmt::format(
      "{}: {} would be {:.3g}, which is not in [{:g}, {:g}]: outside, numbers lose precision or the run "
      "does not end. Choose other values or other units.",
      options, what, value, low, high));
}

void require_record_size(double values, const std::string& options) {
  if (values > 1e8)
    throw UsageError(fmt::format(
        "{}: a replica would keep {:.3g} values, more than 1e8. Choose fewer of either.", options, values));
}

void require_fourth_powers(const Reservoir& left, const Reservoir& right) {
  for (const Reservoir& each : {left, right})
    require_within(each.temperature, 1e-140, 1e140, "--temperature-left, --temperature-right",
                   "a temperature");
}

void require_finite_currents(const OpenChain& chain, double duration, int power) {
  const double hottest = std::max(chain.left.temperature, chain.right.temperature);
  const double crossings = std::max(chain.left.rate + chain.right.rate, 1 / duration);
  require_within(
      power == 1 ? hottest * crossings : hottest * hottest * crossings, 0, 1e295,
      "--temperature-left, --temperature-right, --nu-left, --nu-right, --observation-time",
      fmt::format("the rate of crossings times {}the temperature", power == 1 ? "" : "the square of "));
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

void require_possible(const ClosedChain& chain, double hottest, double end_time, double most_flights,
                      const std::string& temperatures, const std::string& times) {
  const std::uint64_t particles = std::uint64_t{chain.cells} * chain.particles_per_cell;
  if (particles > 1'000'000'000)
    throw UsageError("--cells times --particles-per-cell exceeds 1e9 particles. Choose a smaller chain.");
  require_representable({hottest, chain.cell_length, end_time, static_cast<double>(particles + chain.cells),
                         most_flights, temperatures, times});
}

}  // namespace lorentz
