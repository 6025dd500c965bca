#include "observables/physics_options.hpp"

#include <limits>

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

}  // namespace lorentz
