#pragma once

#include <string>
#include <vector>

#include "program/options.hpp"
#include "statistics/tally.hpp"

namespace lorentz {

/// What --describe prints: a JSON object with the program, its options, and its quantities with their
/// axes (docs/format.md).
std::string describe(const Options& options, const std::string& description,
                     const std::vector<Description>& quantities);

}  // namespace lorentz
