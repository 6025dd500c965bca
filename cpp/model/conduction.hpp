#pragma once

#include <cmath>
#include <string>

#include "model/reservoir.hpp"

namespace lorentz {

/// Why reservoirs impose no gradient of temperature on the scatterers between them, so that the ratio of a
/// current to it is no conductivity [eq. 27], with the remedy; empty if they do. Options are compared
/// exactly. conducts: whether collisions at this sigma exchange energy, and not only momenta
/// (RuleProperties).
inline std::string reason_without_conduction(const Reservoir& left, const Reservoir& right, double gamma,
                                             double sigma, bool conducts) {
  if (left.rate == 0 || right.rate == 0)
    return "heat is conducted between two reservoirs; choose --nu-left and --nu-right above 0";
  if (left.temperature == right.temperature)
    return "the reservoirs have one temperature; choose another --temperature-left or --temperature-right";
  if (gamma == 0) return "no particle is scattered; choose a --gamma above 0";
  if (conducts) return "";
  if (std::abs(sigma) == 1)
    return "scatterers of mass 0 or infinity exchange no energy; choose a --sigma between -1 and 1";
  return "equal masses only exchange momenta, so that no gradient of temperature forms; choose another "
         "--sigma";
}

}  // namespace lorentz
