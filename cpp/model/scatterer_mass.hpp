#pragma once

#include <cmath>
#include <vector>

namespace lorentz {

/// Mass M of a scatterer in units of that of a particle, for sigma = (M-m)/(M+m).
inline double scatterer_mass(double sigma) { return (1 + sigma) / (1 - sigma); }

/// Mass of the scatterers of a chain, from which every collision rule derives, and the unit of their stored
/// velocities w = U / scatterer_scale(). Without set_mass(), M is 0 or infinite, and w = U.
class ScattererMass {
 public:
  /// The ratio U / w.
  double scatterer_scale() const { return scatterer_scale_; }

  /// Converts U of the scatterers to w.
  std::vector<double> scaled(std::vector<double> scatterers) const {
    for (double& scatterer : scatterers) scatterer /= scatterer_scale_;
    return scatterers;
  }

  /// Converts w of the scatterers to U.
  std::vector<double> unscaled(std::vector<double> scatterers) const {
    for (double& scatterer : scatterers) scatterer *= scatterer_scale_;
    return scatterers;
  }

  /// P / U = sqrt(M). At sigma = 1, where M is infinite, it is 0, so that the scatterers' momenta are left
  /// out of every sum.
  double root_mass() const { return root_mass_; }

 protected:
  void set_mass(double root_mass, double scatterer_scale) {
    root_mass_ = root_mass;
    scatterer_scale_ = scatterer_scale;
  }

 private:
  double root_mass_ = 0, scatterer_scale_ = 1;
};

}  // namespace lorentz
