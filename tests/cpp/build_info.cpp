#include "program/build_info.hpp"

namespace lorentz {

/// Stands in for the source that the build generates for each executable.
const BuildInfo build_info{"0.0.0", "source", "build", "compiler", "flags", "libraries"};

}  // namespace lorentz
