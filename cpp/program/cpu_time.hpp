#pragma once

#include <ctime>

namespace lorentz {

/// CPU time of this process, in seconds.
inline double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace lorentz
