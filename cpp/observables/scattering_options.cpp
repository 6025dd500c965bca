#include "observables/scattering_options.hpp"

#include <limits>

namespace lorentz {

void add_scattering_options(Options& options, std::uint32_t& cells, double& sigma, double& gamma,
                            Range<double> gamma_range) {
  options.integer("--cells", cells, {1, 100'000'000}, "Number of cells N");
  options.real("--sigma", sigma, {-1, 1}, "Mass ratio (M-m)/(M+m)");
  options.real_or_word("--gamma", gamma, gamma_range, "N", std::numeric_limits<double>::infinity(),
                       "Mean number of scatterings in N cells; N: every scatterer scatters");
}

}  // namespace lorentz
