#include "program/build_info.hpp"

namespace lorentz {

/// Replaces the source file that the build generates for each executable.
const BuildInfo build_info{"0.0.0", "source", "compiler", "flags", "libraries"};

}  // namespace lorentz
